#pragma once
#include <map>
#include <string>

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
