#pragma once
#include "fem/contact/problem.h"
#include <vector>

namespace mill::contact {
/// The same contact with one unknown for each group of neighbours: every node of a group carries the same force,
/// and the gap of a group is the sum of its gaps.  A start for the active set of the fine problem, nothing more.
struct CoarseProblem {
  Problem problem;            ///< (m) unknowns; C = P^T C P
  std::vector<int> group_of;  ///< (n) into the coarse unknowns
};

/// Groups of `size` nodes.  Neighbours are found in C itself, as those that move most with a node, so that no
/// coordinates are needed.  Cost O(n^2).
CoarseProblem coarse_problem(const Problem &problem, int size);

/// P^T values.
Eigen::VectorXd summed(const CoarseProblem &coarse, const Eigen::VectorXd &values);
}  // namespace mill::contact
