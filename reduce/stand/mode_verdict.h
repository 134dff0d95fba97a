#pragma once
#include "reduce/stand/mode_name.h"
#include "reduce/stand/stand_comparison.h"
#include <set>
#include <string>
#include <vector>

namespace mill::reduce {
/// Names by the shares of each mode alone; a name may come several times.
std::vector<ModeName> own_names(const StandWithModes &stand);

/// A name that comes again gets a number ("order 2"), except those that are fixed.
/// @param fixed  (modes) names that are not changed, with their `keys`
void number_names(std::vector<ModeName> &names, const std::vector<bool> &fixed, std::set<std::string> keys);
}  // namespace mill::reduce
