#pragma once
#include "core/model/roll_geometry.h"
#include "meshes/common/series.h"

namespace mill::meshes {
/// Sizes of the quarter section of a roll: contact point at (0, radius), symmetry lines x = 0 and y = 0.
/// A fine box of quadrilaterals under the contact, one ring of 3:1 templates around it, then a grid that grows
/// geometrically towards the core, so that the number of elements depends on the logarithm of radius / element
/// only.
struct SectionSize {
  double first_element = 0;     ///< m, element width at the contact line
  double growth        = 1;     ///< -, ratio of neighbouring elements along the patch, 1: equal
  int patch_elements   = 12;    ///< along the patch, multiple of 3
  int depth_elements   = 6;     ///< below the patch, multiple of 3
  double depth_growth  = 1.25;  ///< -, ratio of neighbouring elements into the depth
  double far_growth    = 1.5;   ///< -, ratio of neighbouring elements outside the box
  int sector_elements  = 3;     ///< along the far quarter of the outer circle and of the core
};

/// Half width of the patch: sum of its elements.
inline double patch_half_width(const SectionSize &size)
{
  return sum_of(size.first_element, size.growth, size.patch_elements);
}

/// Fewest elements, multiple of 3, whose patch reaches half_width.
int patch_elements_for(double first_element, double growth, double half_width);

/// m, circle that is kept as a mesh line: the neck, or one inside a roll without necks.
inline double core_radius_of(const RollGeometry &roll)
{
  return roll.neck_radius > 0 ? roll.neck_radius : 0.6 * roll.radius;
}

/// x of the place where the outer circle of a section without contact is divided, m: the part above it belongs to
/// contact, that below as barrel.
double plain_contact_half_width(double radius);
}  // namespace mill::meshes
