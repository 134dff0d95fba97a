#pragma once
#include "app/command/calibrate_options.h"
#include "app/twin/calibrate/calibrated_case.h"
#include <string>
#include <vector>

namespace mill {
/// What a record would tell, before anyone measures: a line for each unknown, what would not be seen, and which
/// sensor would help most.  theory.md 45
/// @throws InputError  an option that is wrong
std::string plan_text(const PriorChain &chain, const std::vector<twin::Unknown> &unknowns,
                      const CalibrateOptions &options);
}  // namespace mill
