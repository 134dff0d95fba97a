#pragma once
#include "core/model/mesh_file.h"
#include <array>
#include <functional>
#include <string>
#include <vector>

namespace mill::meshes {
/// Mesh given by its cells: what a grid with parts missing cannot be.
struct CellMesh {
  std::vector<std::array<double, 3>> points;  ///< (n) m; those that no cell uses are left out
  std::vector<std::vector<int>> cells;  ///< 4 corners, counter-clockwise, or 8: bottom counter-clockwise, top
  /// Group of a boundary face by its corners; empty: none.
  std::function<std::string(const std::vector<int> &corners)> group;
};

/// Writes the mesh as Gmsh 4.1 with its boundary groups.
/// @throws SolverError  a cell is inverted
/// Cost: linear; the file is written aside and renamed.
MeshFile write_cells(const CellMesh &mesh, const std::string &path);
}  // namespace mill::meshes
