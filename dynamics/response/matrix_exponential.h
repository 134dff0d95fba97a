#pragma once
#include <Eigen/Core>

namespace mill::dynamics {
/// e^A of a square matrix by scaling, squaring and a Pade approximant, to rounding error of the norm of A.
/// In a file of its own since it takes longer to compile than everything that uses it.
/// Source: N. J. Higham, SIAM J. Matrix Anal. Appl. 26 (2005) 1179, as Eigen implements it.
Eigen::MatrixXd matrix_exponential(const Eigen::MatrixXd &A);
}  // namespace mill::dynamics
