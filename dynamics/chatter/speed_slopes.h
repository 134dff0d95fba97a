#pragma once
#include "dynamics/chatter/sensitivity.h"
#include <vector>

// Slopes of growth rate and critical speed by any input, exact.  theory.md 27.2, 27.3
namespace mill::dynamics {
/// One input, or several that go together: what of it is in the bite, in the structure, in the strip.
struct VariedInput {
  std::string key, name, unit;
  double value = 0;  ///< SI
  std::vector<bite::PassNumber> bite;
  const StructureNumber *structure = nullptr;
  bool entry_distance = false, exit_distance = false, strip_modulus = false;
};

/// The speed of the rolls as an input.
VariedInput roll_speed_input();

/// Everything that one steady state and one eigenvalue say about slopes.
struct Slopes {
  WorkingPoint point;
  bite::LinearSensitivity pass;
  Eigen::MatrixXd A;
  EigenvalueSlope eigenvalue;
  const ChatterStandModel &stand;

  /// d(growth rate)/d ln p, 1/s, (27.5)-(27.7).
  double growth(const VariedInput &varied) const;
  /// d ln(friction)/d ln p and d ln(force)/d ln p.
  double friction(const VariedInput &varied) const;
  double force(const VariedInput &varied) const;
};

/// @param stand     kept by reference
/// @param crossing  whose root is differentiated; nullptr: the least stable one
/// @throws InputError, SolverError  no steady bite there; a double eigenvalue
Slopes slopes_at(const ChatterStandModel &stand, const bite::RollBite &bite, Linearisation scheme, double speed,
                 const Crossing *crossing);

/// d ln v/d ln p of the critical speed, -(d growth/d ln p)/(d growth/d ln v), (27.4).
double speed_slope(const Slopes &slopes, const VariedInput &varied);

/// The crossing that a search calls critical.
const Crossing &critical_crossing(const CriticalSpeed &critical);
}  // namespace mill::dynamics
