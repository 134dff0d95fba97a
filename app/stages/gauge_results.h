#pragma once
#include "app/run_context.h"
#include "core/model/four_high.h"
#include "reduce/chain/mill_modulus.h"
#include <string>

namespace mill {
/// "stand.modulus.kiss"
std::string stand_result(const std::string &quantity, const std::string &aspect = "");

/// stand.screw_sensitivity, stand.thickness_by.*, stand.force_by.* of the first pass from stand.modulus.tangent,
/// K4.plastic_slope and bite.* of the run, beside differences of the coupled solution.  theory.md (30.6)-(30.9)
/// Nothing where the bite has no plastic slope.
/// @param stretch  of the stand with strip over the rolling force
void add_gauge(RunContext &run, const FourHigh &stand, const reduce::LoadDeflection &stretch);
}  // namespace mill
