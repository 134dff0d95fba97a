#pragma once
#include "meshes/common/section.h"
#include "meshes/gmsh/section_sketch.h"

namespace mill::meshes {
/// The core circle of a section (meshes/common/section.h) as the rim meets it, with the mesh inside it.
struct CoreCircle {
  TaggedPoint centre, top, corner, side;  ///< corner: on the circle between top (x = 0) and side (y = 0)
  double corner_angle = 45;               ///< degrees, of the corner from the top
  double corner_share = 0;                ///< -, of the radius: corner of the block in the middle
  int top_elements    = 1;                ///< along the circle from top to corner
  int side_elements   = 1;                ///< from corner to side
  int radial_elements = 1;                ///< from the block in the middle to the circle
  double radial_ratio = 1;                ///< -, of a radial element to the one inside it
};

/// Length of the radial lines from the block in the middle to the circle, on the axes.
double core_depth(const RollGeometry &roll);

/// Surfaces inside the circle: a square with two blocks around it, so that no element has a straight angle.
std::vector<int> add_core(Sketch &sketch, const RollGeometry &roll, const CoreCircle &circle);
}  // namespace mill::meshes
