#include "dynamics/chatter/chatter.h"
#include "core/base/errors.h"
#include "core/base/require.h"
#include "reduce/bite/slab/bland_ford.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace mill::dynamics {
namespace {
Eigen::MatrixXd balanced(const Eigen::MatrixXd &A)
{
  const Eigen::VectorXd scale = balance(A);
  return scale.cwiseInverse().asDiagonal() * A * scale.asDiagonal();
}
}  // namespace

WorkingPoint working_point(bite::RollBite bite, const double speed, const Linearisation scheme)
{
  bite.roll_speed = speed;
  bite.gap_rate   = 0;
  WorkingPoint point;
  point.state = bite::solve_bland_ford(bite, bite::Arc::hitchcock, 0);
  point.by    = bite::linear_coefficients(bite, point.state, scheme);
  point.bite  = std::move(bite);
  return point;
}

Eigen::MatrixXd chatter_matrix(const ChatterStandModel &stand, const bite::LinearCoefficients &by)
{
  const StandStructure &s = stand.structure;
  const Eigen::Index n    = s.n();
  require(stand.entry_distance > 0 && stand.exit_distance > 0, "the strip of a stand has no length");
  const auto &[P, Q, F, mu, xn] = by;
  const double entry            = stand.strip_modulus / stand.entry_distance,
               exit             = stand.strip_modulus / stand.exit_distance;
  const Eigen::MatrixXd inverse = s.M.inverse();
  const Eigen::RowVectorXd gap  = s.b.transpose();
  Eigen::MatrixXd A             = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2);
  A.block(0, n, n, n).setIdentity();
  A.block(n, 0, n, n)         = inverse * (s.b * gap * F[0] - s.K);
  A.block(n, n, n, n)         = inverse * (s.b * gap * F[1] - s.C);
  A.block(n, 2 * n, n, 1)     = inverse * s.b * F[2];
  A.block(n, 2 * n + 1, n, 1) = inverse * s.b * F[3];
  A.row(2 * n) << entry * P[0] * gap, entry * P[1] * gap, entry * P[2], entry * P[3];
  A.row(2 * n + 1) << -exit * Q[0] * gap, -exit * Q[1] * gap, -exit * Q[2], -exit * Q[3];
  return A;
}

Eigen::VectorXd balance(const Eigen::MatrixXd &A)
{
  const Eigen::Index n  = A.rows();
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(n);
  Eigen::MatrixXd B     = A;
  B.diagonal().setZero();
  for (int sweep = 0; sweep < 30; ++sweep) {
    bool moved = false;
    for (Eigen::Index i = 0; i < n; ++i) {
      const double column = B.col(i).norm(), row = B.row(i).norm();
      if (column == 0 || row == 0)
        continue;
      const double f = std::exp2(std::round(0.5 * std::log2(row / column)));
      if (f == 1)
        continue;
      moved = true;
      scale[i] *= f;
      B.col(i) *= f;
      B.row(i) /= f;
    }
    if (!moved)
      break;
  }
  return scale;
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd &A)
{
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(balanced(A), false);
  if (solver.info() != Eigen::Success)
    throw SolverError({"chatter: the eigenvalues of the coupled stand did not converge", "",
                       "a number that is not finite in the matrix",
                       "check masses, stiffnesses and dampings of the stand", ""});
  Eigen::VectorXcd values = solver.eigenvalues();
  std::sort(values.begin(), values.end(), [](const auto &a, const auto &b) {
    return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag();
  });
  return values;
}

double growth_rate(const Eigen::MatrixXd &A)
{
  return eigenvalues(A)[0].real();
}
}  // namespace mill::dynamics
