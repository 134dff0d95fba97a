#pragma once
#include "app/run_context.h"
#include "core/stand.h"
#include <array>

namespace mill {
/// Radial stiffness of the roll-neck bearings at one working load.
struct StandBearings {
  std::array<Parameter, 4>
      Kzc;         ///< N/m, tangent of one bearing: upper backup, upper work, lower work, lower backup
  Parameter K_Zy;  ///< N/m, both bearings of one backup roll, tangent
};

/// Solves the bearings of the stand at the loads that a rolling force puts on them.
/// @param write  true: add Kzc1..4.* to the results and write curves/bearing-*.csv
StandBearings solve_bearings(RunContext &run, const FourHigh &stand, double rolling_force, bool write);
}  // namespace mill
