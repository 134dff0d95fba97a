#pragma once
#include <Eigen/Core>

namespace mill {
/// Gauss-Legendre rule on -1..1: exact for polynomials up to degree 2 n - 1.
struct GaussRule {
  Eigen::VectorXd node;    ///< (n) -
  Eigen::VectorXd weight;  ///< (n) -, sum 2
};

/// Rule of n points.  Nodes are the eigenvalues of the Jacobi matrix of the Legendre polynomials.  Cost O(n^3).
/// Source: G. H. Golub, J. H. Welsch, Math. Comp. 23 (1969) 221.
GaussRule gauss_legendre(int n);
}  // namespace mill
