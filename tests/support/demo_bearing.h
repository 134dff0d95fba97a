#pragma once
#include "core/model/roller_bearing.h"
#include <cmath>

/// Work-roll bearing of the demo stand, 266.7 x 355.6 mm, no clearance, no crown.
inline mill::RollerBearing demo_bearing(const double cup_angle_deg = 19.66)
{
  constexpr double degree = M_PI / 180;
  mill::RollerBearing b;
  b.name              = "trb";
  b.type              = mill::BearingType::four_row_tapered;
  b.bore              = 0.2667;
  b.outside_diameter  = 0.3556;
  b.width             = 0.230188;
  b.rollers_per_row   = 39;
  b.roller_length     = 0.0334;
  b.roller_diameter   = 0.0215;
  b.roller_cone_angle = 2.5 * degree;
  b.cup_angle         = cup_angle_deg * degree;
  return b;
}
