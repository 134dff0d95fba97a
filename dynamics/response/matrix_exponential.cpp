#include "dynamics/response/matrix_exponential.h"
#include <unsupported/Eigen/MatrixFunctions>

namespace mill::dynamics {
Eigen::MatrixXd matrix_exponential(const Eigen::MatrixXd &A)
{
  return A.exp();
}
}  // namespace mill::dynamics
