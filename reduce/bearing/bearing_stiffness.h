#pragma once
#include "reduce/bearing/roller_set.h"
#include <Eigen/Core>

// Second derivative of the energy of an assembled bearing.  theory.md 5.5
namespace mill::bearing {
/// The rings' part eliminated; n motions.
struct BearingStiffness {
  Eigen::MatrixXd root;         ///< (rows Z modes, rank) L, slopes of all rollers = L L^T
  Eigen::MatrixXd press;        ///< (rank, n) L^T times the approach for a unit of each motion
  Eigen::MatrixXd bend;         ///< (rank, rows Z ring modes) L^T S
  Eigen::MatrixXd solved;       ///< (rank, n) H^-1 press, H = I + L^T S L
  Eigen::VectorXd solved_bend;  ///< (rank) H^-1 L^T S imbalance
  Eigen::MatrixXd tangent;      ///< (n, n) d(force)/d(motion)
};

/// @param rollers      their slopes and which of them are on the raceway
/// @param press        (rows Z modes, n) approach for a unit of each motion
/// @param flexibility  S, (rows Z ring modes)^2 m/N; empty: rigid rings
/// @param imbalance    (rows Z ring modes) N, roller loads less the loads that bend the rings
/// Cost: rank^3 / 3 with elastic rings, rank at most loaded rollers x modes.
BearingStiffness bearing_stiffness(const RollerForces &rollers, const Eigen::MatrixXd &press,
                                   const Eigen::MatrixXd &flexibility, const Eigen::VectorXd &imbalance);
}  // namespace mill::bearing
