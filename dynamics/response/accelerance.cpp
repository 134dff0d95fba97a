#include "dynamics/response/accelerance.h"
#include "core/base/errors.h"
#include "core/base/require.h"
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

namespace mill::dynamics {
namespace {
using Complex = std::complex<double>;

/// Square root of a symmetric positive definite matrix by Newton's iteration in the product form of Denman and
/// Beavers, scaled by the determinant: N. J. Higham, Functions of Matrices (2008), (6.29).
Eigen::MatrixXd square_root(const Eigen::MatrixXd &A)
{
  const Eigen::Index n    = A.rows();
  const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd X = A, Y = I;
  double before = 1;
  for (int step = 0; step < 60; ++step) {
    const Eigen::LLT<Eigen::MatrixXd> factor_x(X), factor_y(Y);
    const double logs          = 2 * (factor_x.matrixLLT().diagonal().array().log().sum() +
                             factor_y.matrixLLT().diagonal().array().log().sum());
    const double mu            = std::exp(-logs / (2 * double(n)));
    const Eigen::MatrixXd next = 0.5 * (mu * X + factor_y.solve(I) / mu);
    Y                          = 0.5 * (mu * Y + factor_x.solve(I) / mu);
    const double change        = (next - X).norm() / next.norm();
    X                          = 0.5 * (next + next.transpose());
    Y                          = 0.5 * (Y + Y.transpose()).eval();
    if (!std::isfinite(change))
      break;
    // Quadratic until rounding, some eps times the condition, takes over.
    if (change < 1e-15 * double(n) || (change < 1e-7 && change >= 0.5 * before))
      return X;
    before = change;
  }
  throw SolverError({"damping of a stand by the square root of its matrices: no convergence",
                     "60 steps of Newton's iteration", "a stiffness or mass that is not positive",
                     "check the masses and stiffnesses of the stand", ""});
}
}  // namespace

ModalResponse modal_response(const StandModel &stand, const Eigen::VectorXd &frequency,
                             const Eigen::MatrixXd &shape, const std::vector<Eigen::VectorXd> &seen,
                             const std::vector<Eigen::VectorXd> &pushed, const double damping,
                             const double gap_damper)
{
  require(frequency.size() == shape.cols(), "every shape needs a frequency");
  const auto rows = [&](const std::vector<Eigen::VectorXd> &places) {
    Eigen::MatrixXd in_modes(Eigen::Index(places.size()), shape.cols());
    for (std::size_t p = 0; p < places.size(); ++p)
      in_modes.row(Eigen::Index(p)) = places[p].transpose() * shape;
    return in_modes;
  };
  ModalResponse response{frequency,  rows(seen), rows(pushed), shape.transpose() * stand.b, damping,
                         gap_damper, {}};
  std::vector<Eigen::VectorXd> dampers;
  for (const Connection &c : stand.connections)
    for (Eigen::Index r = 0; r < c.rows.rows() && c.damper > 0; ++r)
      dampers.push_back(std::sqrt(c.damper) * c.rows.row(r).transpose());
  response.dampers = rows(dampers);
  return response;
}

ModalResponse first_modes(const ModalResponse &all, const Eigen::Index n)
{
  return {all.frequency.head(n),
          all.seen.leftCols(n),
          all.pushed.leftCols(n),
          all.gap.head(n),
          all.damping,
          all.gap_damper,
          all.dampers.rows() > 0 ? Eigen::MatrixXd(all.dampers.leftCols(n)) : Eigen::MatrixXd()};
}

Eigen::MatrixXcd accelerance(const ModalResponse &s, const double frequency)
{
  const double w                    = 2 * M_PI * frequency;
  const Eigen::VectorXcd receptance = s.frequency.unaryExpr([&](const double f) {
    const double omega = 2 * M_PI * f;
    return Complex(1) / Complex((omega - w) * (omega + w), 2 * s.damping * omega * w);  // (32.3)
  });
  Eigen::MatrixXcd y                = s.seen * receptance.asDiagonal() * s.pushed.transpose();
  Eigen::MatrixXd joined            = s.dampers;  // rows that dampers act along, times the root of each
  if (s.gap_damper > 0) {
    joined.conservativeResize(joined.rows() + 1, s.gap.size());
    joined.bottomRows(1) = std::sqrt(s.gap_damper) * s.gap.transpose();
  }
  if (joined.rows() > 0) {  // (32.4)
    const Eigen::MatrixXcd by_dampers = receptance.asDiagonal() * joined.transpose().cast<Complex>();
    Eigen::MatrixXcd closing          = Complex(0, w) * (joined.cast<Complex>() * by_dampers);
    closing.diagonal().array() += Complex(1);
    y -= Complex(0, w) * (s.seen * by_dampers) *
         closing.partialPivLu().solve(Eigen::MatrixXcd((s.pushed * by_dampers).transpose()));
  }
  return -w * w * y;
}

Eigen::MatrixXd modal_damping_matrix(const Eigen::MatrixXd &M, const Eigen::MatrixXd &K, const double damping)
{
  // M = L L^T: the root is taken of the symmetric L^-1 K L^-T.
  const Eigen::MatrixXd L = Eigen::LLT<Eigen::MatrixXd>(M).matrixL();
  const auto lower        = L.triangularView<Eigen::Lower>();
  Eigen::MatrixXd A       = lower.solve(K);
  A                       = lower.solve(A.transpose().eval());
  A                       = 0.5 * (A + A.transpose()).eval();
  const double unit       = A.norm();
  return 2 * damping * std::sqrt(unit) * L * square_root(A / unit) * L.transpose();  // (32.5)
}

DampedStand damped_stand(const StandModel &stand, const double damping, const double gap_damper)
{
  DampedStand s{stand.M, stiffness_of(stand), {}};
  s.C = modal_damping_matrix(s.M, s.K, damping) + gap_damper * stand.b * stand.b.transpose() + dampers_of(stand);
  return s;
}

Complex direct_accelerance(const DampedStand &s, const Eigen::VectorXd &seen, const Eigen::VectorXd &pushed,
                           const double frequency)
{
  const double w = 2 * M_PI * frequency;
  Eigen::MatrixXcd dynamic(s.M.rows(), s.M.cols());
  dynamic.real()           = s.K - w * w * s.M;
  dynamic.imag()           = w * s.C;
  const Eigen::VectorXcd y = dynamic.partialPivLu().solve(pushed.cast<Complex>());  // (32.1)
  return -w * w * seen.cast<Complex>().cwiseProduct(y).sum();
}

Eigen::VectorXd frequencies_around(const Eigen::VectorXd &modes, const double damping, const double low,
                                   const double high)
{
  constexpr double even   = 1.02;  // ratio of neighbours far from every resonance
  constexpr double thin   = 1e-3;  // damping that the steps are made for where there is less
  const double half_width = std::max(damping, thin);
  std::vector<double> all;
  for (double f = low; f < high; f *= even)
    all.push_back(f);
  all.push_back(high);
  for (const double mode : modes)
    for (const double half_widths : {0.12, 0.25, 0.5, 0.75, 1., 1.5, 2., 3., 5., 8., 13.})
      for (const double side : {-1., 1.})
        if (const double f = mode * (1 + side * half_widths * half_width); f > low && f < high)
          all.push_back(f);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(), [](const double a, const double b) { return b - a < 1e-9 * b; }),
            all.end());
  return Eigen::Map<const Eigen::VectorXd>(all.data(), Eigen::Index(all.size()));
}
}  // namespace mill::dynamics
