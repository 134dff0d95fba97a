#pragma once
#include "dynamics/chatter/sensitivity.h"
#include "dynamics/response/modal_model.h"
#include <vector>

// A stand in its modes whose springs and masses move: the modal damping follows.  theory.md 27.3, 27.6
namespace mill::dynamics {
/// What an input does to the matrices of a stand in its modes.
struct ModalChange {
  Eigen::MatrixXd dK;       ///< (n, n) 1/s2, per relative change of the input; empty: none
  Eigen::MatrixXd dM;       ///< (n, n) -, the same of the mass; empty: none
  Eigen::MatrixXd dL = {};  ///< (n, n) 1/s2, the same of the loss; empty: none
};

/// Damping that is stated for every mode and so follows springs and masses: mode k has the ratio of critical
/// ratio + loss_kk / (2 w_k^2), (38.28).
struct DampingOfModes {
  double ratio         = 0;   ///< -
  Eigen::MatrixXd loss = {};  ///< (n, n) 1/s2, stiffnesses times their loss factors; empty: none
};

/// C_by of that change: damping of the modes that follows stiffness and mass, (27.9), (27.16).  Of two modes of
/// one frequency the mixed terms by the loss have no derivative and are 0.
/// @param frequency  (n) Hz
Eigen::MatrixXd damping_by(const Eigen::VectorXd &frequency, const DampingOfModes &damping,
                           const ModalChange &change);

/// C of that damping, (27.10).
Eigen::MatrixXd damping_matrix(const Eigen::MatrixXd &K, const Eigen::MatrixXd &M, const DampingOfModes &damping);

/// The structure with modal stiffness and mass changed.  Its damping is that of its own modes; what C has beyond
/// that (dampers of oil films) stays as it is.
/// @param stand          with C = damping_matrix(K, M, before) + dampers
/// @param before, after  damping of the modes of stand and of the changed structure
/// @param change         (n, n) 1/s2 and -, added to K and M
StandStructure moved_structure(const StandStructure &stand, const DampingOfModes &before,
                               const DampingOfModes &after, const ModalChange &change);
}  // namespace mill::dynamics
