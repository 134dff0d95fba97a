#include "core/numerics/gauss.h"
#include <Eigen/Eigenvalues>
#include <cmath>

namespace mill {
GaussRule gauss_legendre(const int n)
{
  Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
  for (int i = 1; i < n; ++i)
    jacobi(i, i - 1) = jacobi(i - 1, i) = i / std::sqrt(4.0 * i * i - 1);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(jacobi);
  return {modes.eigenvalues(), 2 * modes.eigenvectors().row(0).array().square().transpose()};
}
}  // namespace mill
