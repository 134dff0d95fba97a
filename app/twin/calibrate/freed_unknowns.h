#pragma once
#include "app/twin/calibrate/calibrated_case.h"
#include <string>
#include <vector>

namespace mill {
/// Unknowns of --free, with their priors.  Parts of the list are separated by commas:
///   K3, M2, zeta, zeta2   one spring, mass, or damping ratio
///   M2/M5                 one factor moves all of them
///   frame                 one factor for the springs of the frame and one for its masses
///   springs, masses       each of them
///   ratios                a damping ratio for each mode
/// Without a list: every spring and the common damping ratio; masses whose error the case states only where the
/// force was recorded, since accelerations alone show ratios of stiffness to mass.
/// @throws InputError  a name that the stand does not have, or that appears twice
std::vector<twin::Unknown> freed_unknowns(const PriorChain &prior, const std::string &list, bool force_recorded);
}  // namespace mill
