#pragma once
#include "core/records/speed_verdict.h"
#include <vector>

namespace mill {
struct Case;
struct ClosedFormMemory;

/// Critical speed of each pass of a four-high stand with its interval, on the six masses that the closed forms
/// give; the run has it on the most detailed model.  A pass that says too little has a verdict that names the
/// keys. theory.md 25, 27.6
/// @param memory  after closed_form_chain of this case
/// Cost: some 30 ms for each pass.
std::vector<SpeedVerdict> closed_form_speeds(const Case &the_case, const ClosedFormMemory &memory);
}  // namespace mill
