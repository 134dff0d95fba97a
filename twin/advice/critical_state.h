#pragma once
#include "dynamics/chatter/speed.h"
#include <limits>
#include <string>

namespace mill::twin {
/// A stand at its working speed, and the speed above which it is unstable.
struct CriticalState {
  dynamics::CriticalSpeed search;
  double speed  = 0;      ///< m/s, critical one; without one the end of the range that is stable or unstable
  bool at_least = false;  ///< nothing grows up to `speed`
  bool no_bite  = false;  ///< no steady bite exists at the working speed
  std::string why;        ///< why not
  double force    = std::numeric_limits<double>::quiet_NaN();  ///< N, at the working speed
  double torque   = std::numeric_limits<double>::quiet_NaN();  ///< N m, one roll
  double friction = std::numeric_limits<double>::quiet_NaN();  ///< -
  double growth   = std::numeric_limits<double>::quiet_NaN();  ///< 1/s, of the least stable mode
  double output   = std::numeric_limits<double>::quiet_NaN();  ///< m3/s, strip that leaves
};
/// Cost: one search, some 10 ms with six masses.
CriticalState critical_state(const dynamics::ChatterStandModel &stand, const bite::RollBite &bite,
                             Linearisation scheme, const dynamics::SpeedRange &range, double working_speed);
}  // namespace mill::twin
