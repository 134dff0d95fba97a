#pragma once
#include "core/records/stand_model.h"
#include "dynamics/response/state_space.h"
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace mill::dynamics {
/// A stand in n of its modes, seen at m points.  theory.md (7.14)
struct ModalModel {
  std::vector<std::string> labels;  ///< (m) points; the first six are those of M1..M6
  Eigen::VectorXd frequency;        ///< (n) Hz, ascending
  Eigen::MatrixXd point;            ///< (m, n) kg^-1/2, displacement of each point in each mass-normalised mode
  Eigen::VectorXd force;            ///< (n) kg^-1/2, bite force on each mode
  Eigen::VectorXd load_cell;        ///< (n) N/m kg^-1/2, load-cell force per modal displacement
  double load_cell_share = 1;       ///< -, part of the mean bite force that the load cell shows
  double damping         = 0;       ///< -, ratio of critical of every mode
  double gap_damper      = 0;       ///< N s/m, C between the work rolls, over the strip's width
  Eigen::MatrixXd dampers;          ///< (n, n) N s/(m kg), of the connections, oil films; empty: none
  /// (n, n) -, mass above and below the strip in the modes; a housing is part of neither; empty: not known
  std::array<Eigen::MatrixXd, 2> stack_mass{};
};

/// The modes of a stand up to `highest` (Hz).  What is left out is the motion of faster modes, which a force below
/// `highest` moves like springs without mass.
/// @param frequency  (k) Hz, ascending
/// @param shape      (unknowns, k) kg^-1/2, mass-normalised
ModalModel modal_model(const StandModel &stand, const Eigen::VectorXd &frequency, const Eigen::MatrixXd &shape,
                       double damping, double highest, double gap_damper = 0);

/// (unknowns, unknowns) N s/m: the damping matrix of a stand whose every mode of `shape` has the same damping
/// ratio, of a damper between the work rolls, and of the dampers of its connections; modes that are left out are
/// not damped.  theory.md (6.3), (6.4)
Eigen::MatrixXd damping_matrix(const StandModel &stand, const Eigen::VectorXd &frequency,
                               const Eigen::MatrixXd &shape, double damping, double gap_damper = 0);

/// (r, n) rows D with D^T D = C, of a damping matrix (n, n) of few dampers; r is its rank.
Eigen::MatrixXd damper_rows(const Eigen::MatrixXd &C);

/// First-order form in [w q; q']; outputs are the accelerations of the points, then the change of the load-cell
/// force, as state_space(MillModel).
StateSpace state_space(const ModalModel &model);
}  // namespace mill::dynamics
