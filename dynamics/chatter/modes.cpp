#include "dynamics/chatter/modes.h"
#include "core/base/errors.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace mill::dynamics {
namespace {
using Complex = std::complex<double>;

double degrees(const Complex z)
{
  return z == 0. ? not_given : std::arg(z) * 180 / M_PI;
}

// Amplitude of a point by its name; nan: no such point.
double amplitude_of(const std::vector<ChatterPoint> &body, const std::string &label)
{
  for (const ChatterPoint &b : body)
    if (b.label == label)
      return b.amplitude;
  return not_given;
}
}  // namespace

Eigen::VectorXcd eigenvector(const Eigen::MatrixXd &A, const std::complex<double> root)
{
  const Eigen::Index s    = A.rows();
  const Eigen::VectorXd d = balance(A);
  Eigen::MatrixXcd B      = (d.cwiseInverse().asDiagonal() * A * d.asDiagonal()).cast<Complex>();
  // Slightly shifted from the root, so that the factors stay finite; three steps give the rounding of the matrix.
  B.diagonal().array() -= root + Complex(1, 1) * (1e-14 * B.norm());
  const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(B);
  Eigen::VectorXcd x(s);
  for (Eigen::Index i = 0; i < s; ++i)  // no vector of a stand is normal to this
    x[i] = {1 + 0.1 * std::sin(double(i + 1)), 0.1 * std::cos(3. * double(i + 1))};
  for (int step = 0; step < 3; ++step) {
    x = lu.solve(x);
    Eigen::Index largest;
    x.cwiseAbs().maxCoeff(&largest);
    x /= Complex(x[largest]);
  }
  return d.asDiagonal() * x;
}

ChatterMode chatter_mode(const ChatterStandModel &stand, const bite::LinearCoefficients &by, const Complex root)
{
  const StandStructure &structure = stand.structure;
  const Eigen::Index n            = structure.n();
  ChatterMode mode;
  mode.root      = root;
  mode.frequency = std::abs(root.imag()) / (2 * M_PI);
  mode.damping   = -root.real() / std::abs(root);
  mode.state     = eigenvector(chatter_matrix(stand, by), root);
  // The gap as the scale, unless this mode leaves it alone but for rounding.
  const Eigen::VectorXcd points = structure.point * mode.state.head(n);
  const Complex gap             = structure.b.cast<Complex>().dot(mode.state.head(n));
  Eigen::Index largest;
  const double reach   = points.cwiseAbs().maxCoeff(&largest);
  const bool has_gap   = std::abs(gap) > 1e-10 * reach;
  const Complex factor = 1. / (has_gap ? gap : points[largest]);
  mode.state *= factor;
  mode.gap           = gap * factor;
  const Complex rate = root * mode.gap, entry = mode.state[2 * n], exit = mode.state[2 * n + 1];
  const auto change = [&](const bite::StripRow &row) {
    return row[0] * mode.gap + row[1] * rate + row[2] * entry + row[3] * exit;
  };
  mode.force         = change(by.force);
  mode.friction      = change(by.friction);
  mode.entry_tension = entry;
  mode.exit_tension  = exit;
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    const Complex moved = points[i] * factor;
    mode.body.push_back({structure.labels[std::size_t(i)], std::abs(moved), degrees(moved)});
  }
  mode.work_roll_ratio = amplitude_of(mode.body, "upper work roll") / amplitude_of(mode.body, "lower work roll");
  if (has_gap) {
    mode.force_phase         = degrees(mode.force);
    mode.entry_tension_phase = degrees(entry);
    mode.exit_tension_phase  = degrees(exit);
    mode.friction_phase      = degrees(mode.friction);
    mode.force_to_friction   = degrees(mode.friction == 0. ? Complex(0) : mode.force / mode.friction);
  }
  return mode;
}

FreeModes free_modes(const StandStructure &s)
{
  const Eigen::Index n = s.n();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> undamped(s.K, s.M);
  if (undamped.info() != Eigen::Success)
    throw InputError("the masses of the structure are not positive: it has no modes");
  FreeModes free;
  free.undamped = undamped.eigenvalues().cwiseMax(0).cwiseSqrt() / (2 * M_PI);
  free.shape    = s.point * undamped.eigenvectors();
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index largest;
    free.shape.col(k).cwiseAbs().maxCoeff(&largest);
    if (const double scale = free.shape(largest, k); scale != 0)
      free.shape.col(k) /= scale;
  }
  Eigen::MatrixXd A(2 * n, 2 * n);
  A << Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Identity(n, n), -s.M.partialPivLu().solve(s.K),
      -s.M.partialPivLu().solve(s.C);
  std::vector<Complex> vibrating;
  for (const Complex root : eigenvalues(A)) {
    if (root.imag() > 0)
      vibrating.push_back(root);
  }
  std::sort(vibrating.begin(), vibrating.end(),
            [](const Complex a, const Complex b) { return std::abs(a) < std::abs(b); });
  free.frequency.resize(Eigen::Index(vibrating.size()));
  free.damping.resize(Eigen::Index(vibrating.size()));
  for (Eigen::Index k = 0; k < free.frequency.size(); ++k) {
    const Complex root = vibrating[std::size_t(k)];
    free.frequency[k]  = std::abs(root) / (2 * M_PI);
    free.damping[k]    = -root.real() / std::abs(root);
  }
  free.overdamped = int(n) - int(vibrating.size());
  return free;
}
}  // namespace mill::dynamics
