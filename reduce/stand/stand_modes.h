#pragma once
#include "core/records/stand_model.h"
#include <Eigen/Core>
#include <limits>

namespace mill::reduce {
/// Undamped modes of a stand, m of them, ascending.
struct StandModes {
  Eigen::VectorXd frequency;       ///< (m) Hz
  Eigen::MatrixXd shape;           ///< (n, m) mass-normalised; the largest of the first six points is positive
  Eigen::MatrixXd kinetic;         ///< (parts, m) share of the kinetic energy, columns sum to 1
  Eigen::MatrixXd strain;          ///< (connections, m) share of the strain energy
  Eigen::MatrixXd strain_of_part;  ///< (parts, m) share of the strain energy; with `strain` columns sum to 1
  Eigen::VectorXd error_estimate;  ///< (m) relative, from modes left out of the parts (22.9) or from a coarser
                                   ///< mesh; NaN: none is known
};

/// Modes up to a frequency limit (Hz), all by default.  theory.md (22.7)-(22.9)
/// @throws InputError  a part that nothing holds, named with its direction; M not positive definite
/// Cost O(n^3), 50 ms for 300 unknowns.
StandModes stand_modes(const StandModel &stand, double limit = std::numeric_limits<double>::infinity());

/// Error estimate of `fine` from the same stand with half the elements: order 2, a gain of 4 in
/// mesh_pair_error(), by the mode of the same rank.
void estimate_errors(StandModes &fine, const StandModes &coarse);

/// (n) m: displacement under a bite force of 1 N.  theory.md (22.6)
/// @throws InputError  a part that nothing holds, named with its direction
Eigen::VectorXd static_displacement(const StandModel &stand);

/// (n, k): columns with K x = right side.  Errors as static_displacement.
Eigen::MatrixXd static_solution(const StandModel &stand, const Eigen::MatrixXd &right);

/// (p, n): rows of the first p points.
Eigen::MatrixXd point_rows(const StandModel &stand, Eigen::Index p);

/// The stand without one of its connections (no connection of that name: unchanged).
StandModel without(StandModel stand, const std::string &connection);
}  // namespace mill::reduce
