#pragma once
#include "app/run/run_context.h"
#include "core/model/four_high.h"

namespace mill {
/// Puts what [housing] and [screwdown] give into stand.frame: frame.* results with closed forms and the given
/// values that they are compared with, fields/housing.vtu; the errors of its meshes become tolerances of the
/// frame.
void resolve_frame(RunContext &run, FourHigh &stand);
}  // namespace mill
