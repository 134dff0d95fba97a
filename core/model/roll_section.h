#pragma once
#include "core/model/stand.h"
#include <cmath>

// What every formula of a roll takes from its drawing across the axis.
namespace mill {
/// A round section of a roll.
struct RoundSection {
  double diameter = 0;  ///< m
};

inline RoundSection barrel_section(const Roll &roll)
{
  return {roll.barrel_diameter};
}

inline RoundSection neck_section(const Roll &roll)
{
  return {roll.neck_diameter};
}

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

/// kg/m
inline double mass_per_length(const RoundSection &section, const Material &material)
{
  return material.density * area_of(section);
}
}  // namespace mill
