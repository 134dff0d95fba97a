#pragma once
#include "twin/chatter/critical_track.h"
#include <optional>
#include <string>
#include <vector>

namespace mill::twin {
/// The doubt whose key is the longest beginning of `key`; nullptr: none.
const InputDoubt *doubt_of(const std::vector<InputDoubt> &doubts, const std::string &key);

/// The critical speed that a search has found; none unless its verdict is a crossing.
std::optional<CriticalPoint> critical_point(const dynamics::CriticalSpeed &critical);

/// Slope of a critical speed to one number of the pass, of the structure or of the strip next to the stand.
struct CriticalSlope {
  std::string key, name;  ///< as dynamics::SensitivityTable has them
  double slope;           ///< -, d ln v_crit/d ln p
};
/// (27.4)-(27.7).  @throws SolverError  two roots in one, which have no slope.  Cost: 0.5 ms with six masses.
std::vector<CriticalSlope> critical_slopes(const ChatterModel &model, const bite::RollBite &bite,
                                           const CriticalPoint &critical);
}  // namespace mill::twin
