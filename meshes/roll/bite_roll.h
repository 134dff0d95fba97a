#pragma once
#include "core/model/mesh_file.h"
#include <string>
#include <vector>

namespace mill::meshes {
/// Where the surface of a work roll is resolved around the line of centres.  Lengths of the arc are given in units
/// of sqrt(R dh), so that one setting serves every pass.
struct BiteRollSize {
  double radius            = 0;     ///< m
  double arc               = 0;     ///< m, sqrt(R dh)
  double reach             = 2.4;   ///< -, of arc: points from -reach to reach
  double fine              = 1.5;   ///< -, of arc: equal spacing up to here
  double spacing           = 0.04;  ///< -, of arc: between neighbouring points
  double growth            = 1.15;  ///< -, ratio of neighbouring spacings beyond `fine`
  int elements_per_spacing = 1;     ///< quadratic elements between neighbouring points
  double far_growth        = 1.25;  ///< -, ratio of neighbouring elements into the depth and beyond the points
};

/// (n) m, rising and symmetric: distances from the line of centres of the points the pressure is given at.
/// @throws InputError  sizes that are no arc on a roll: not positive, or reach past 40 degrees of the circle
std::vector<double> arc_points(const BiteRollSize &size);

/// Quarter of the section of a solid roll, contact line at (0, radius), quadrilaterals whose corners hold the
/// points x >= 0.  Groups surface (the quarter circle), symmetry.x (x = 0), symmetry.y (y = 0).
/// Rays from the core to the surface, and a block in the core, so that no ring of transition elements lies where
/// stresses are high.
/// @throws InputError  as arc_points
MeshFile mesh_bite_roll(const BiteRollSize &size, const std::string &path);
}  // namespace mill::meshes
