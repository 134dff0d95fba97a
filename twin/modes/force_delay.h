#pragma once
#include "twin/modes/force_modes.h"

namespace mill::twin {
/// How far the vibrations lag behind the force beyond what the stand does: two clocks, a filter in one of two
/// amplifiers.
struct ForceDelay {
  double seconds   = 0;      ///< s, positive: the vibrations come late
  double deviation = 0;      ///< s, standard deviation
  bool identified  = false;  ///< one delay within +-50 ms fits, others do not
};

/// From the phases of the residues, which real modes without a delay have at +-90 degrees.  theory.md (42.14)
/// @param order  of differentiation of the channels: 2 accelerations, 1 velocities
ForceDelay force_delay(const std::vector<ForcedMode> &modes, int order);

/// Takes a delay out of H: H exp(+i w tau).
void align(ForceResponse &response, double seconds);
}  // namespace mill::twin
