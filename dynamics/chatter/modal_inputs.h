#pragma once
#include "dynamics/chatter/sensitivity.h"
#include "dynamics/response/modal_model.h"
#include <vector>

// A stand in its modes whose springs and masses move: the modal damping follows.  theory.md 27.3, 27.6
namespace mill::dynamics {
/// What an input does to the matrices of a stand in its modes.
struct ModalChange {
  Eigen::MatrixXd dK;  ///< (n, n) 1/s2, per relative change of the input; empty: none
  Eigen::MatrixXd dM;  ///< (n, n) -, the same of the mass; empty: none
};

/// C_by of that change: modal damping that follows stiffness and mass, (27.9).
/// @param frequency  (n) Hz
/// @param damping    -, ratio of critical of every mode
Eigen::MatrixXd damping_by(const Eigen::VectorXd &frequency, double damping, const ModalChange &change);

/// The structure with modal stiffness and mass changed, each mode of it again with the damping ratio, (27.10).
/// @param stand   structure_of(ModalModel)
/// @param change  (n, n) 1/s2 and -, added to K and M
StandStructure moved_structure(const StandStructure &stand, double damping, const ModalChange &change);
}  // namespace mill::dynamics
