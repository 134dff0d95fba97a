#pragma once
#include "app/twin/calibrate/calibrated_case.h"
#include <string>

namespace mill {
/// What measured levels without a record tell: how they follow damping, bandwidth of the force and the contacts,
/// and that two of them determine one number, so that neither damping nor bandwidth is given.  theory.md (45.6)
/// @throws InputError  a place that the chain does not have
std::string levels_text(const PriorChain &chain, const RecordSet &set);
}  // namespace mill
