#pragma once
#include "app/run/driven_stand.h"

namespace mill {
/// Adds the static rest of the modes that are left out as one more mode, so that the displacements under a
/// constant rolling force are those of the whole stand, and measures what the reduction costs.  theory.md 35.8 A
/// chain, and a stand on curves, stay as they are. Cost: all modes of the stand, 50 ms for 300 unknowns.
void add_static_rest(DrivenStand &stand);
}  // namespace mill
