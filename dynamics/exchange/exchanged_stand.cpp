#include "dynamics/exchange/exchanged_stand.h"
#include "dynamics/response/frequency_response.h"
#include "dynamics/response/modes.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <fmt/format.h>

namespace mill::dynamics {
namespace {
using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

std::string spoken(std::string label)
{
  std::replace(label.begin(), label.end(), '_', ' ');
  return label;
}

std::string unit_of(const ExchangedStand &stand, const bool rate)
{
  if (stand.modal)
    return rate ? "m.kg0.5/s" : "m.kg0.5";
  return rate ? "m/s" : "m";
}

// Frequency of the mode with the largest part of the static yielding, b_k / omega_k squared.
double leading(const VectorXd &frequency, const VectorXd &force)
{
  Index k = 0;
  force.cwiseQuotient(frequency.cwiseMax(1e-9)).cwiseAbs().maxCoeff(&k);
  return frequency[k];
}
}  // namespace

ExchangedStand exchanged(const MillModel &chain, const DynamicsSettings &settings, const double gap_damper)
{
  ExchangedStand stand;
  stand.M                 = chain.M.asDiagonal();
  stand.C                 = 0.5 * (chain.C + chain.C.transpose());
  stand.K                 = chain.K;
  stand.b                 = chain.b;
  stand.point             = MatrixXd::Identity(chain.M.size(), chain.M.size());
  stand.load_cell         = chain.load_cell;
  stand.load_cell_share   = chain.load_cell_share;
  stand.springs           = chain.springs;
  stand.modal_damping     = settings.modal_damping;
  stand.gap_damper        = gap_damper;
  const Modes undamped    = modes(chain);
  stand.frequency         = undamped.frequency;
  stand.leading_frequency = leading(undamped.frequency, undamped.shape.transpose() * chain.b);
  return stand;
}

ExchangedStand exchanged(const ModalModel &modes)
{
  const Index n      = modes.frequency.size();
  const VectorXd rad = 2 * M_PI * modes.frequency;
  ExchangedStand stand;
  stand.modal     = true;
  stand.frequency = modes.frequency;
  stand.M         = MatrixXd::Identity(n, n);
  stand.K         = rad.cwiseAbs2().asDiagonal();
  stand.C         = modes.gap_damper * modes.force * modes.force.transpose();
  stand.C.diagonal() += 2 * modes.damping * rad;
  if (modes.dampers.size() > 0) {
    stand.C += modes.dampers;
    stand.dampers = damper_rows(modes.dampers);
  }
  stand.b                 = modes.force;
  stand.leading_frequency = leading(modes.frequency, modes.force);
  stand.point             = modes.point;
  stand.load_cell         = modes.load_cell;
  stand.load_cell_share   = modes.load_cell_share;
  stand.modal_damping     = modes.damping;
  stand.gap_damper        = modes.gap_damper;
  for (Index k = 0; k < n; ++k)
    stand.unknowns.push_back(fmt::format("mode_{}", k + 1));
  return stand;
}

std::vector<Signal> states_of(const ExchangedStand &stand)
{
  std::vector<Signal> all;
  for (const bool rate : {false, true})
    for (std::size_t k = 0; k < stand.unknowns.size(); ++k) {
      const std::string what =
          stand.modal
              ? fmt::format("{}, {:.6g} Hz, mass-normalised", spoken(stand.unknowns[k]), stand.frequency[Index(k)])
              : spoken(stand.unknowns[k]) + ", up positive, from the state of rest under F_mean";
      all.push_back({(stand.modal ? (rate ? "p_" : "q_") : (rate ? "v_" : "y_")) + stand.unknowns[k],
                     unit_of(stand, rate), (rate ? "velocity of the " : "displacement of the ") + what});
    }
  return all;
}

std::vector<Signal> outputs_of(const ExchangedStand &stand)
{
  std::vector<Signal> all;
  for (const std::string &point : stand.points)
    all.push_back({"a_" + point, "m/s2", "acceleration of the " + spoken(point) + ", up positive"});
  for (const std::string &point : stand.points)
    all.push_back({"y_" + point, "m",
                   "displacement of the " + spoken(point) + ", up positive, from the state of rest under F_mean"});
  all.push_back({"dF_cell", "N",
                 fmt::format("force on the load cell less its share of the mean force, {} N, compression positive",
                             stand.load_cell_share * stand.mean_force)});
  return all;
}

Signal input_of(const ExchangedStand &stand)
{
  return {"dF_roll", "N", fmt::format("{}, less its mean {} N", stand.force_text, stand.mean_force)};
}

StateSpace first_order_form(const ExchangedStand &stand)
{
  const Index n = stand.b.size(), m = stand.point.rows();
  const Eigen::PartialPivLU<MatrixXd> mass(stand.M);
  StateSpace form;  // (35.9)
  form.A                         = MatrixXd::Zero(2 * n, 2 * n);
  form.A.topRightCorner(n, n)    = MatrixXd::Identity(n, n);
  form.A.bottomLeftCorner(n, n)  = mass.solve(-stand.K);
  form.A.bottomRightCorner(n, n) = mass.solve(-stand.C);
  form.B                         = VectorXd::Zero(2 * n);
  form.B.tail(n)                 = mass.solve(stand.b);
  form.C                         = MatrixXd::Zero(2 * m + 1, 2 * n);
  form.C.topRows(m)              = stand.point * form.A.bottomRows(n);
  form.C.block(m, 0, m, n)       = stand.point;
  form.C.row(2 * m).head(n)      = stand.load_cell.transpose();
  form.D                         = VectorXd::Zero(2 * m + 1);
  form.D.head(m)                 = stand.point * form.B.tail(n);
  return form;
}

namespace {
// Poles above or on the real axis.  The states are scaled first: the matrix has entries of 1 and entries of K/M.
std::vector<std::complex<double>> poles_of(const MatrixXd &A)
{
  const Index n  = A.rows() / 2;
  double largest = 0;
  for (Index i = 0; i < n; ++i)
    largest = std::max(largest, A.row(n + i).head(n).cwiseAbs().sum());
  const double unit = std::sqrt(std::max(largest, 1e-300));
  MatrixXd scaled   = A;
  scaled.topRightCorner(n, n) *= unit;
  scaled.bottomLeftCorner(n, n) /= unit;
  std::vector<std::complex<double>> poles;
  for (const auto &pole : scaled.eigenvalues())
    if (pole.imag() >= 0)
      poles.push_back(pole);
  return poles;
}

Eigen::VectorXcd response_of(const StateSpace &system, const double frequency)
{
  using Complex           = std::complex<double>;
  Eigen::MatrixXcd matrix = -system.A.cast<Complex>();
  matrix.diagonal().array() += Complex(0, 2 * M_PI * frequency);
  return system.C.cast<Complex>() * matrix.partialPivLu().solve(system.B.cast<Complex>()) +
         system.D.cast<Complex>();
}
}  // namespace

double difference_from(const StateSpace &form, const DrivenModel &driven, const VectorXd &frequency)
{
  if (form.A.rows() != driven.system.A.rows() || form.C.rows() < driven.system.C.rows())
    return INFINITY;
  double worst = 0;
  // Own states are scaled already, [w q; q'].
  std::vector<std::complex<double>> mine;
  for (const auto &pole : driven.system.A.eigenvalues())
    if (pole.imag() >= 0)
      mine.push_back(pole);
  const auto theirs = poles_of(form.A);
  for (std::size_t k = 0; k < mine.size(); ++k) {
    // Near a double pole (critical damping) rounding moves both by its root; the response covers it.
    const auto is_double = [&](const std::complex<double> &other) {
      return &other != &mine[k] && std::abs(other - mine[k]) < 1e-3 * std::abs(mine[k]);
    };
    if (mine[k].imag() < 1e-3 * std::abs(mine[k]) || std::any_of(mine.begin(), mine.end(), is_double))
      continue;
    double nearest = INFINITY;
    for (const auto &other : theirs)
      nearest = std::min(nearest, std::abs(other - mine[k]));
    worst = std::max(worst, nearest / std::abs(mine[k]));
  }
  const Index m           = Index(driven.labels.size());
  const auto add_response = [&](const double f, Eigen::MatrixXcd &all, const Index column) {
    const Eigen::VectorXcd mine_now = response_of(driven.system, f), other = response_of(form, f);
    all.col(column) << mine_now.head(m + 1), other.head(m), other[other.size() - 1];
  };
  constexpr Index n_points = 60;
  const double low = 0.1 * frequency[0], high = 3 * frequency[frequency.size() - 1];
  Eigen::MatrixXcd all(2 * (m + 1), n_points);
  for (Index i = 0; i < n_points; ++i)
    add_response(low * std::pow(high / low, double(i) / double(n_points - 1)), all, i);
  for (Index row = 0; row <= m; ++row) {
    const double largest = all.row(row).cwiseAbs().maxCoeff();
    if (largest > 0)
      worst = std::max(worst, (all.row(row) - all.row(m + 1 + row)).cwiseAbs().maxCoeff() / largest);
  }
  return std::isnan(worst) ? INFINITY : worst;
}

void add_step_test(ExchangedStand &stand, const DrivenModel &driven)
{
  stand.step_force = stand.mean_force > 0 ? 0.1 * stand.mean_force : 1e5;
  // The jump takes 1 ns: its end is a sample of the record, the grid begins behind it.
  constexpr double jump = 1e-9;
  ForceRecord record{Eigen::Vector3d(0, jump, step_test_end - step_test_begin),
                     Eigen::Vector3d(0, stand.step_force, stand.step_force),
                     {}};
  const double rate    = std::clamp(100 * stand.frequency[stand.frequency.size() - 1], 1e4, 2e5);
  const auto response  = mill_response(driven, record, rate);
  const VectorXd jumps = driven.system.D * stand.step_force;
  for (const int roll : {0, 1}) {
    const Index column = roll == 0 ? upper_work_roll : lower_work_roll;
    stand.step_peak[roll] =
        std::max(std::abs(jumps[column]), response.acceleration.col(column).cwiseAbs().maxCoeff());
  }
}
}  // namespace mill::dynamics
