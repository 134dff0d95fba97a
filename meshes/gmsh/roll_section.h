#pragma once
#include "meshes/common/section.h"
#include <vector>

namespace mill::meshes {
/// Surfaces of the section in the current Gmsh model (built-in kernel, synchronised by the caller): all
/// quadrilateral, transfinite, conforming.  core: inside the core circle; rim: between it and the barrel.
struct SectionSurfaces {
  std::vector<int> core, rim;
};
SectionSurfaces add_section(const RollGeometry &roll, const SectionSize &size);

/// Quarter section of a roll without a contact: five blocks of about equal elements, for bodies that bend and
/// vibrate as a whole.  The circle of the neck is kept as a mesh line.
SectionSurfaces add_plain_section(const RollGeometry &roll, int elements_per_radius);
}  // namespace mill::meshes
