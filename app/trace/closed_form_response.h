#pragma once
#include "app/trace/closed_form_chain.h"
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "core/model/pass.h"
#include <array>

namespace mill {
/// Force record of a pass, read or made once.
const ForceRecord &remembered_force(const Pass &pass, ClosedFormMemory &memory);

/// g, of the work rolls under the record itself: upper peak, upper rms, lower peak, lower rms.
/// Cost: one integration of the record, nothing where this chain has been driven before.
std::array<double, 4> driven_levels(const LumpedModel &model, const DynamicsSettings &settings, const Pass &pass,
                                    ClosedFormMemory &memory);

/// g, rms of both work rolls under a force of the same rms that is white up to the bandwidth of the record, from
/// the frequency response.  Between records of one spectrum the slope of the rms scatters by some hundredths,
/// since each has its own hills where a mode moves along; this one does not.  theory.md (24.3) NaN without
/// damping, or for a force that does not change.  Cost: at most 576 complex solves of six equations.
std::array<double, 2> white_levels(const LumpedModel &model, const DynamicsSettings &settings, const Pass &pass,
                                   ClosedFormMemory &memory);
}  // namespace mill
