#pragma once
#include "meshes/roll/section.h"

namespace mill::meshes {
/// Quarter section of a roll without a contact: five blocks of about equal elements, for bodies that bend and
/// vibrate as a whole.  The circle of the neck is kept as a mesh line.
///
/// Surfaces of the section in the current Gmsh model (built-in kernel), all quadrilateral, conforming.
SectionSurfaces add_plain_section(const RollGeometry &roll, int elements_per_radius);

/// x of the place where the outer circle is divided, m: the part above it counts as contact, that below as barrel.
double plain_contact_half_width(double radius);
}  // namespace mill::meshes
