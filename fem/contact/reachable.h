#pragma once
#include <Eigen/Core>
#include <vector>

namespace mill::contact {
/// Forces that press and have given resultants.
struct Support {
  std::vector<int> nodes;       ///< (a) at most as many as there are resultants
  Eigen::VectorXd force;        ///< > 0, of the first nodes; nodes behind them carry nothing
  Eigen::VectorXd missing;      ///< (k) resultant - G^T force: no pressing forces come closer
  double relative_missing = 0;  ///< -, |missing| / |resultant|
};

/// Least squares  min |G^T force - resultant|  over force >= 0, by the active set of Lawson and Hanson (Solving
/// Least Squares Problems, 1974, chapter 23).  `missing` separates: if it is not zero, G missing <= 0, so that a
/// body which presses on any of the nodes can only be moved away from the resultant by it.
/// @param G  (n, k) scaled to entries of about one
/// Cost O(n k) per node taken.
Support pressing_support(const Eigen::MatrixXd &G, const Eigen::VectorXd &resultant);
}  // namespace mill::contact
