#pragma once
#include "core/model/ring_sections.h"
#include "core/model/roller_bearing.h"
#include "core/model/roller_setup.h"

namespace mill::bearing {
/// Deformation of the rings that the law of one roller already contains.
struct RacewayDatum {
  double depth_inner = not_given;  ///< m, of the cone's raceway in the law of one roller; absent: wall at mid-row
  double depth_outer = not_given;  ///< m, of the cup's; absent: wall at mid-row
  double land = not_given;  ///< m, straight raceway beyond the line's ends, as the law of one roller has it;
                            ///< absent: a tenth of the roller length, less where there is no room
};

/// Meridian sections of cone and cup as drawn, and what the cup sits in.  The raceway's middle lies half a roller
/// diameter off the pitch circle, perpendicular to the roller's axis; cup and cone are inclined by their own
/// contact angles (cup_angle and cup_angle - roller_cone_angle).  theory.md 15
/// @throws InputError  rows overlap or leave the bearing's width; a raceway leaves the ring; a chock smaller than
/// the
///                     bearing or with a dimension missing; a land that does not fit; says which and by how much
RingSections ring_sections(const RollerBearing &bearing, const RacewayDatum &datum = {});

/// The walls of the rings, which the law of one roller includes; what is beyond them belongs to the rings.
/// @throws InputError  as ring_walls
RacewayDatum law_datum(const RollerBearing &bearing);

/// One roller between its raceways as drawn, held at the depths of law_datum, with the land of the rings; what
/// holds the cup does not matter.
/// @param largest_load  N, on one roller
/// @throws InputError  as ring_sections
RollerSetup roller_setup(RollerBearing bearing, double largest_load);

/// m, wall of a ring at mid-row, along the normal of the raceway: the depth that the law of one roller contains.
double ring_wall(const RingSection &section);
}  // namespace mill::bearing
