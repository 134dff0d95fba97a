#pragma once
#include "core/records/campbell_record.h"
#include <optional>
#include <string>
#include <vector>

// Orders of what turns, and the speeds at which they meet the modes of a stand.  theory.md 32.4
namespace mill::dynamics {
/// The line of something that happens `per_turn` times while a roll of this diameter (m) turns once.  (32.9)
CampbellLine line_of(std::string name, std::string group, std::string shaft, double per_turn, double diameter);

/// How far a speed (m/s) is from a range, over the nearer end: negative below, 0 inside, NaN without a range.
double distance_from(double speed, const std::array<double, 2> &range);

/// Every speed within `speeds` at which a line meets a mode, mode by mode, by the speed.  (32.9)
std::vector<CampbellCrossing> crossings(const std::vector<CampbellMode> &modes,
                                        const std::vector<CampbellLine> &lines,
                                        const std::array<double, 2> &speeds, const std::array<double, 2> &working);

/// The crossing of one mode nearest to the working range; of several inside it the one nearest to its middle.
/// Nothing without a crossing or a range.
std::optional<CampbellCrossing> nearest(const CampbellRecord &record, int mode);
}  // namespace mill::dynamics
