#pragma once
#include "core/model/mesh_file.h"
#include <string>
#include <vector>

namespace mill::meshes {
/// Piece of a raceway under one contact line: everything between the raceway and a concentric back, cut off at the
/// last mesh lines.  The contact point is the origin, y points out of the piece, z runs along the line.
struct RacewayPiece {
  double radius = 0;          ///< m, of the raceway: > 0 convex (cone), < 0 concave (cup), 0 flat
  std::vector<double> x;      ///< m, mesh lines on the raceway from 0, distance from the plane x = 0
  std::vector<double> depth;  ///< m, mesh lines below the raceway, from 0
  std::vector<double> z;      ///< m, from 0; empty: plane section
  double patch_x = 0;         ///< m, the group "patch" is what may touch: x up to here ...
  double patch_z = 0;         ///< m, ... and z up to here; 0: to the end
};

/// Writes it with the groups patch, top (the rest of the raceway), back, side (last x), symmetry.x (x = 0) and, in
/// space, symmetry.z (z = 0), end (last z).
/// @throws InputError   lines that do not start at zero or do not ascend, a convex piece deeper than its radius
MeshFile mesh_raceway(const RacewayPiece &piece, const std::string &path);
}  // namespace mill::meshes
