#pragma once
#include "core/model/mesh_file.h"
#include <string>
#include <vector>

namespace mill::meshes {
/// Mesh lines from 0 to `length`: `n_fine` equal elements over `fine`, then elements that grow by about `growth`
/// until `length` is reached.
struct GradedLine {
  double fine   = 0;    ///< m, 0: growth starts at once with an element of fine_element
  int n_fine    = 0;    ///< elements over it
  double first  = 0;    ///< m, size of the first growing element; 0: that of the fine ones
  double growth = 1.5;  ///< -, ratio of neighbouring elements, adjusted so that the last one fits
  double length = 0;    ///< m
};
std::vector<double> mesh_lines(const GradedLine &line);
/// n equal elements from a to b.
std::vector<double> even_lines(double a, double b, int n);

/// Rectangle or brick between its first and last mesh lines; the face y = last is the one that touches.
struct BlockGrid {
  std::vector<double> x, y, z;   ///< m, ascending; z empty: a plane or meridian section
  double patch_from_x = -1e300;  ///< m, the group "patch" is the part of the top with x from here ...
  double patch_x      = 0;       ///< m, ... up to here; 0: to the end
  double patch_z      = 0;       ///< m, and with z up to here; 0: all of it
};

/// Writes the block with the groups left, right (x), bottom, top (y), back, front (z) and patch.
/// @throws SolverError  mesh lines that do not ascend
MeshFile mesh_block(const BlockGrid &grid, const std::string &path);
}  // namespace mill::meshes
