#pragma once
#include "dynamics/response/mill_model.h"
#include <Eigen/Core>

namespace mill::dynamics {
/// x' = A x + B F,  output = C x + D F.
struct StateSpace {
  Eigen::MatrixXd A;  ///< (s, s) 1/s
  Eigen::VectorXd B;  ///< (s)
  Eigen::MatrixXd C;  ///< (m, s)
  Eigen::VectorXd D;  ///< (m)
};

/// First-order form of a model of n masses in normalised undamped modal coordinates: s = 2n states [w q; q'].
/// Outputs, m = n + 1: accelerations y'' (m/s2), then the change of the load-cell force (N).  theory.md (7.1)
///
/// Why not [y; y']: there A mixes entries of 1 and of K/M = 4e8, and an eigensolver or a matrix exponential loses
/// eight digits to the scale alone.  In [w q; q'] the undamped A is skew and its norm is the highest frequency.
/// Cost O(n^3).
StateSpace state_space(const MillModel &model);

/// State at rest under a constant force (N):  A x = -B F.  (s)  theory.md (7.7)
/// @throws SolverError  A is singular: a part of the chain is not held to the ground
Eigen::VectorXd equilibrium(const StateSpace &system, double force);
}  // namespace mill::dynamics
