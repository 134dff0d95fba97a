#pragma once
#include "core/model/roll.h"

namespace mill::reduce {
/// How much smaller the radius of a roll is at z than at mid-length of an unshifted roll without crown: ground
/// crown (parabola, table or polynomial), thermal crown and end chamfer.  theory.md (2.12)
/// @param z  m, from the roll's own mid-length
/// @return   m, positive: smaller radius
double radius_drop(const Roll &roll, double z);

/// True when the two halves of the barrel differ, by more than a hundredth of a micrometre.
bool is_one_sided(const Roll &roll);

/// Extra distance of two cylinders whose axes cross at mid-length by `angle` (rad) and pass each other at `offset`
/// (m), measured from their distance at mid-length without offset.  Along the barrel the contact follows the line
/// that joins the axes, so that only the distance of the axes matters.  theory.md (2.13)
/// @param between  m, sum of the two radii
double crossing_gap(double between, double angle, double offset, double z);
}  // namespace mill::reduce
