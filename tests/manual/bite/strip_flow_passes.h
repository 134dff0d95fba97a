#pragma once
#include "fem/strip/rigid_plastic/strip_flow.h"
#include "tests/manual/bite/bite_passes.h"
#include <string>

// Passes rolled by finite elements.
namespace mill::verify {
/// Rigid-plastic state on a mesh of along x along/4 elements made for the pass.
/// @param finest  -, smallest element along the arc over the largest
fem::StripFlow rolled(const bite::RollBite &bite, int along, const fem::StripFlowModel &model = {},
                      double finest = 0.25, const bite::ArcFlexibility *flexibility = nullptr,
                      const fem::StripFlow *start = nullptr);
}  // namespace mill::verify
