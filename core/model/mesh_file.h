#pragma once
#include "core/model/roll_geometry.h"
#include <map>
#include <string>

namespace mill {
/// A mesh on disk (Gmsh 4.1, hexahedra, SI) with named boundary groups.
struct MeshFile {
  std::string path;
  std::string hash;  ///< of the inputs and the code version that made it
  double unit =
      1;  ///< m, of the coordinates on disk: a roll is meshed as one of radius 1, so that its size is exact
  RollGeometry geometry;
  int n_cells               = 0;
  int n_nodes               = 0;      ///< corner nodes
  double contact_element    = 0;      ///< m, element width on the contact patch at the contact line
  double contact_half_width = 0;      ///< m, half width of the patch that may touch
  double smallest_jacobian  = 0;      ///< -, min over cells of det J at corners over its mean
  std::map<std::string, int> groups;  ///< "contact", "symmetry.x", ... -> boundary id
};
}  // namespace mill
