#pragma once
#include "core/base/each_member.h"
#include "core/model/material.h"
#include <cmath>

// The shape of a roll: the solid that is meshed, and its sections across the axis for the formulas of beams and
// masses.  core/model/roll.h takes both from a drawing.
namespace mill {
/// Geometry of an eighth of a roll as it was meshed: x = 0, y = 0, z = 0 are its symmetry planes, the axis is z,
/// the contact line is x = 0, y = radius.
struct RollGeometry {
  double radius              = 0;  ///< m, of the barrel
  double half_length         = 0;  ///< m, of the barrel
  double neck_radius         = 0;  ///< m, 0: no neck
  double neck_length         = 0;  ///< m, from the barrel end to the end of the roll
  double seat_centre         = 0;  ///< m, z of the bearing centre, 0: none
  double contact_half_length = 0;  ///< m, part of the barrel that may touch; 0: all of it
};

template <class Io, class R, if_record<R, RollGeometry> = 0> void each_member(Io &&io, R &record)
{
  auto &[radius, half_length, neck_radius, neck_length, seat_centre, contact_half_length] = record;
  io("radius", radius);
  io("half_length", half_length);
  io("neck_radius", neck_radius);
  io("neck_length", neck_length);
  io("seat_centre", seat_centre);
  io("contact_half_length", contact_half_length);
}

/// A round section of a roll.
struct RoundSection {
  double diameter = 0;  ///< m
};

/// m2
inline double area_of(const RoundSection &section)
{
  return M_PI * section.diameter * section.diameter / 4;
}

/// m4, second moment of area about a diameter.
inline double second_moment_of(const RoundSection &section)
{
  return area_of(section) * section.diameter * section.diameter / 16;
}

/// -, share of the area that carries shear: Cowper 1966, 6 (1 + nu) / (7 + 6 nu), at nu = 0.3.
inline double shear_factor_of(const RoundSection &)
{
  return 0.886;
}

/// kg/m
inline double mass_per_length(const RoundSection &section, const Material &material)
{
  return material.density * area_of(section);
}
}  // namespace mill
