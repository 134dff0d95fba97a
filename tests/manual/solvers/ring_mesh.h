#pragma once
#include "core/model/mesh_file.h"
#include "meshes/common/section.h"
#include <string>
#include <vector>

namespace mill::meshes {
/// Quarter of a ring, 0 <= theta <= pi/2 from the x axis, plane section.
/// @param radii    m, ascending
/// @param n_angle  elements around
/// Groups inner, outer, symmetry.y (on the x axis), symmetry.x (on the y axis).
MeshFile mesh_ring(const std::vector<double> &radii, int n_angle, const std::string &path);

/// Quarter of a solid disc, contact point at (0, radius): section.h in the plane.
/// Groups patch, rim (the circle beyond it), symmetry.x (x = 0), symmetry.y (y = 0).
/// @throws SolverError  the patch does not fit the circle
MeshFile mesh_disc(double radius, const SectionSize &size, const std::string &path);
}  // namespace mill::meshes
