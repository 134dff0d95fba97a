#pragma once
#include "core/records/stand_model.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/state_space.h"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill::live {
/// A stand of n unknowns in k of its modes, seen at m places, as the twin steps it: x = [w q; q'], y = V q.
struct SteppedStand {
  std::vector<std::string> labels;  ///< (m) places
  dynamics::StateSpace system;      ///< of x; outputs: accelerations of the places, then the load cell
  Eigen::VectorXd frequency;        ///< (k) Hz, undamped, ascending
  Eigen::MatrixXd shape;            ///< (n, k) V, kg^-1/2
  Eigen::MatrixXd to_modes;         ///< (k, n) V^T M
  Eigen::MatrixXd point;            ///< (m, k) kg^-1/2, displacement of each place in each mode
  Eigen::VectorXd still;            ///< (n) m/N, displacement under a constant bite force, of these modes
};

/// A chain of n masses in all its modes; its places are the masses.
/// @throws SolverError  a part of the chain is not held
SteppedStand stepped_stand(const dynamics::MillModel &chain);

/// A stand whose mass matrix is one (DetailedTwin::stand) in its modes up to `highest`, Hz.
/// @throws SolverError  its springs do not hold it
SteppedStand stepped_stand(const StandModel &stand, double highest, double damping, double gap_damper);

/// "upper_work_roll", in the order of the labels.
std::vector<std::string> places_of(const SteppedStand &stand);

/// s, after which a free motion of the slowest mode has died out to e^-5.  theory.md (48.6)
/// @throws InputError  the model has no damping, so that a start would be seen for ever
double settling_time(const SteppedStand &stand);
}  // namespace mill::live
