#pragma once
#include "app/stages/bearing/bearing_study.h"

namespace mill {
/// Supports of the chock that bearing_across will ask for.
std::vector<bearing::ChockSupport> supports_across(const RollerBearing &bearing);

/// Stiffness of a bearing across the load it carries, N/m: what a roll feels that moves along the pass line under
/// the rolling force.  A block chock then bears with its whole side on the liner of the housing window instead of
/// on its supports (theory.md 6, horizontal motion); its error estimate is of this quantity: roller's mesh, rings'
/// mesh, slices, or the spread of the published laws of one roller, and the distance to the supports where the
/// case leaves them open.  Without inputs: those are of the seat.  Cost: a coarse chock once per bearing, then
/// from the cache.
Parameter bearing_across(RunContext &run, const BearingStudy &study);
}  // namespace mill
