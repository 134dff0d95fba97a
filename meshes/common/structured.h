#pragma once
#include "core/model/mesh_file.h"
#include <array>
#include <functional>
#include <string>
#include <vector>

namespace mill::meshes {
/// Grid of quadrilaterals (two directions) or hexahedra (three): nodes numbered with the first direction fastest.
struct StructuredGrid {
  std::vector<int> n;                         ///< (2 or 3) nodes along each direction
  std::vector<std::array<double, 3>> points;  ///< (product of n) m
  /// Group of the boundary face of a cell: direction 0..2, side 0 (first) or 1 (last), middle of the face in m.
  std::function<std::string(int direction, int side, const std::array<double, 3> &middle)> group;
};

/// Writes the grid as Gmsh 4.1 with its boundary groups.
/// @throws SolverError  a cell is inverted
/// Cost: linear; the file is written aside and renamed.
MeshFile write_grid(const StructuredGrid &grid, const std::string &path);
}  // namespace mill::meshes
