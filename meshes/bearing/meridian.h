#pragma once
#include "core/model/mesh_file.h"
#include <string>

namespace mill::meshes {
/// How fine the meridian section of a roll is meshed: a product grid, thin under the surface and where the contact
/// ends, so that the number of elements depends on the logarithm of radius / element only.
struct MeridianSize {
  double surface_element = 0;     ///< m, thickness of the elements at the barrel surface
  double radial_growth   = 1.7;   ///< -, ratio of neighbouring elements towards the axis
  double end_layer       = 0;     ///< m, length of the last element before the end of the contact
  double layer_growth    = 1.8;   ///< -, ratio of neighbouring elements towards mid-length
  double largest_share   = 0.03;  ///< -, longest element over the length of the contact on one side
  double core_share      = 0.12;  ///< -, thickest element over the radius
};

/// Sizes for a contact whose half width at the largest load is `half_width` (m).
MeridianSize meridian_size(double half_width);
/// The same for a roll of a stack: contacts and strip may end anywhere along its barrel.
MeridianSize even_meridian_size(double half_width);
/// The same grid with elements of half the size everywhere.
MeridianSize refined(const MeridianSize &size);

/// Meshes the half z >= 0 of a roll's meridian section in coordinates r, z and writes it with the groups axis,
/// symmetry.z, contact, barrel (what of the barrel does not touch), neck, shoulder, end.
/// @param name  roll as the user calls it, for messages
/// @throws SolverError  the mesh has other elements than quadrilaterals
/// Cost: some hundredths of a second; the file is written aside and renamed.
MeshFile mesh_meridian(const std::string &name, const RollGeometry &geometry, const MeridianSize &size,
                       const std::string &path);
}  // namespace mill::meshes
