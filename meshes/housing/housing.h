#pragma once
#include "core/model/housing.h"
#include "core/model/mesh_file.h"
#include <string>

namespace mill::meshes {
/// How finely a housing is meshed; everything else follows from the first number.
struct HousingMeshSize {
  int through    = 4;    ///< elements through posts and beams, from the window outwards
  double stretch = 1.5;  ///< -, length of an element along a post or beam over its width, at most about
  double longest = 0;    ///< m, length of an element along them, at most (fem::longest_housing_element); 0: any
};

/// @throws InputError  with every dimension that is not positive or does not fit the others, named by its key
void require_housing(const MillHousing &housing);

/// Half the height of the band on the outside of each post that represents its foot, m: a quarter of the post's
/// width, less where the straight part of the post leaves no room.  theory.md 23.1
double foot_half_height(const MillHousing &housing);

/// Quarter x >= 0, z >= 0 of a housing, one grid of hexahedra bent around the corners of the window: first
/// direction from the middle of the lower beam along the post to the middle of the upper one, second from the
/// outside to the window, third along the rolls from the middle outwards.  y = 0 is the window's bottom.
/// Groups: symmetry.x, symmetry.z, screw, seat, foot, window, outside, side.  theory.md 23.1
/// @throws InputError   require_housing()
/// @throws SolverError  a cell is inverted
MeshFile mesh_housing(const MillHousing &housing, const HousingMeshSize &size, const std::string &path);
}  // namespace mill::meshes
