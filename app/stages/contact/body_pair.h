#pragma once
#include "core/model/two_cylinders.h"
#include "reduce/chain/line_contact.h"
#include <optional>

namespace mill {
struct Case;

/// A metre of two elastic cylinders of one material, for the laws that are written for rolls; else nothing.
std::optional<reduce::CylinderPair> one_steel(const TwoCylinders &pair);

/// A tilt that lifts more than half of the contact off.  @throws InputError with the place of the tilt
void check_tilt(const Case &the_case);
}  // namespace mill
