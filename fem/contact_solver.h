#pragma once
#include <Eigen/Core>
#include <vector>

namespace mill::fem {
/// Frictionless unilateral contact of two condensed bodies, theory.md (2.6):
///     gap = initial_gap + C force + support F - q >= 0,   force >= 0,   force . gap = 0,   sum force = F
struct ContactProblem {
  Eigen::MatrixXd C;            ///< (n, n) m/N, symmetric, positive definite
  Eigen::VectorXd support;      ///< (n) m/N, displacement by what balances 1 N of contact force
  Eigen::VectorXd initial_gap;  ///< (n) m, >= 0, 0 where the undeformed bodies first touch
};

struct ContactState {
  double force = 0;          ///< N, sum of the nodal forces
  double q     = 0;          ///< m, closing of the frames in which C and support are written
  Eigen::VectorXd nodal;     ///< (n) N, >= 0
  Eigen::VectorXd d_nodal;   ///< (n) -, derivative with respect to the force, active set held: exact tangent
  double d_q = 0;            ///< m/N
  std::vector<char> active;  ///< (n)
  int iterations  = 0;
  double residual = 0;  ///< -, largest violation of the four conditions, relative
};

/// Solves for an imposed force by a primal-dual active set on the dense operator; ends on the exact active set, so
/// there is no tolerance to choose.  A warm start needs the active set of a neighbouring load.
/// @throws SolverError  no set after 60 exchanges, which a positive definite C excludes
/// Cost: a Cholesky factorisation of the active block per iteration.
ContactState solve_contact(const ContactProblem &problem, double force, const std::vector<char> &start = {});
}  // namespace mill::fem
