#pragma once
#include <Eigen/Core>

namespace mill {
/// x between its bounds with the least |A x - b|.  A (m, n) has full column rank.  An active set, changed one
/// unknown at a time: each step lessens |A x - b|, so it ends.  Source: P. B. Stark, R. L. Parker, Computational
/// Statistics 10 (1995) 129.  Cost: some n least squares of (m, n).
Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd &A, const Eigen::VectorXd &b,
                                      const Eigen::VectorXd &low, const Eigen::VectorXd &high);
}  // namespace mill
