#pragma once
#include "tests/manual/check/verification.h"
#include <vector>

// One roller between its raceways in space, both contacts unilateral.
namespace mill::verify {
std::vector<Check> fe_roller_3d();
std::vector<Check> roller_slice_law();
std::vector<Check> roller_tilt();
std::vector<Check> published_rollers();
std::vector<Check> roller_on_ring();  ///< the law of one roller and the ring behind it, against both in one model
}  // namespace mill::verify
