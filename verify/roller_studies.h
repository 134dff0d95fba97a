#pragma once
#include "verify/verification.h"
#include <vector>

// One roller between its raceways in space, both contacts unilateral.
namespace mill::verify {
std::vector<Check> fe_roller_3d();
std::vector<Check> roller_slice_law();
std::vector<Check> roller_tilt();
}  // namespace mill::verify
