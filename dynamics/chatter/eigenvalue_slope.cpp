#include "core/base/errors.h"
#include "dynamics/chatter/sensitivity.h"
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace mill::dynamics {
namespace {
/// Eigenvector of the eigenvalue next to `value`.
Eigen::VectorXcd vector_of(const Eigen::MatrixXd &A, std::complex<double> &value)
{
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(A, true);
  if (solver.info() != Eigen::Success)
    throw SolverError({"chatter: the eigenvectors of the coupled stand did not converge", "",
                       "a number that is not finite in the matrix",
                       "check masses, stiffnesses and dampings of the stand", ""});
  Eigen::Index i = 0;
  (solver.eigenvalues().array() - value).abs().minCoeff(&i);
  value = solver.eigenvalues()[i];
  return solver.eigenvectors().col(i);
}
}  // namespace

EigenvalueSlope slope_of_eigenvalue(const Eigen::MatrixXd &A, const std::complex<double> near)
{
  const Eigen::VectorXd scale  = balance(A);
  const Eigen::MatrixXd scaled = scale.cwiseInverse().asDiagonal() * A * scale.asDiagonal();
  EigenvalueSlope s;
  s.value                            = near;
  const Eigen::VectorXcd x           = vector_of(scaled, s.value);
  std::complex<double> same          = s.value;
  const Eigen::VectorXcd w           = vector_of(scaled.transpose(), same);  // w^T A = lambda w^T
  const std::complex<double> product = w.transpose() * x;
  // 1/|product| is the condition of the eigenvalue; a double one without two vectors has none.
  if (!(std::abs(product) > 1e-7))
    throw SolverError({"chatter: the least stable eigenvalue has no derivative",
                       "two eigenvalues coincide at " + std::to_string(s.value.imag() / (2 * M_PI)) + " Hz",
                       "two modes become one at this speed", "the finite changes, which need no derivative", ""});
  s.right = scale.asDiagonal() * x;
  s.left  = scale.cwiseInverse().asDiagonal() * (w / product).conjugate();
  return s;
}

std::complex<double> EigenvalueSlope::by(const Eigen::MatrixXd &A_by) const
{
  return left.dot(A_by * right);
}

Eigen::MatrixXd chatter_matrix_by(const ChatterStandModel &stand, const bite::LinearCoefficients &by)
{
  const StandStructure &s       = stand.structure;
  const Eigen::Index n          = s.n();
  const auto &[P, Q, F, mu, xn] = by;
  const double entry            = stand.strip_modulus / stand.entry_distance,
               exit             = stand.strip_modulus / stand.exit_distance;
  const Eigen::VectorXd push    = s.M.partialPivLu().solve(s.b);
  const Eigen::RowVectorXd gap  = s.b.transpose();
  Eigen::MatrixXd A             = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2);
  A.middleRows(n, n) << push * gap * F[0], push * gap * F[1], push * F[2], push * F[3];
  A.row(2 * n) << entry * P[0] * gap, entry * P[1] * gap, entry * P[2], entry * P[3];
  A.row(2 * n + 1) << -exit * Q[0] * gap, -exit * Q[1] * gap, -exit * Q[2], -exit * Q[3];
  return A;
}

Eigen::MatrixXd chatter_matrix_by(const ChatterStandModel &stand, const bite::LinearCoefficients &coefficients,
                                  const StructureNumber &number)
{
  const Eigen::Index n = stand.structure.n();
  Eigen::MatrixXd A    = Eigen::MatrixXd::Zero(2 * n + 2, 2 * n + 2);
  if (number.K_by.size())
    A.block(n, 0, n, n) -= number.K_by;
  if (number.C_by.size())
    A.block(n, n, n, n) -= number.C_by;
  if (number.M_by.size())
    A.middleRows(n, n) -= number.M_by * chatter_matrix(stand, coefficients).middleRows(n, n);
  A.middleRows(n, n) = stand.structure.M.partialPivLu().solve(A.middleRows(n, n)).eval();  // (27.6)
  return A;
}
}  // namespace mill::dynamics
