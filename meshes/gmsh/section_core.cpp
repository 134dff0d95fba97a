#include "meshes/gmsh/section_core.h"

namespace mill::meshes {
namespace {
constexpr double block_share = 0.5;  // of the core circle: corners of the square on the axes
}

double core_depth(const RollGeometry &roll)
{
  return (1 - block_share) * core_radius_of(roll);
}

std::vector<int> add_core(Sketch &sketch, const RollGeometry &roll, const CoreCircle &c)
{
  const int m = c.top_elements, ns = c.side_elements;
  const double r      = core_radius_of(roll);
  const auto outwards = [&](const TaggedPoint &from, const TaggedPoint &to) {
    return sketch.line(from, to, c.radial_elements, c.radial_ratio);
  };
  const int top_arc   = sketch.arc(c.top, c.centre, c.corner, m);
  const int side_arc  = sketch.arc(c.corner, c.centre, c.side, ns);
  const TaggedPoint a = sketch.point(0, block_share * r);
  const TaggedPoint b = sketch.at_angle(c.corner_share * r, c.corner_angle);
  const TaggedPoint d = sketch.point(block_share * r, 0);
  const int a_b = sketch.line(a, b, m), b_d = sketch.line(b, d, ns), b_corner = outwards(b, c.corner);
  return {
      sketch.block({sketch.line(c.centre, d, m), -b_d, -a_b, sketch.line(a, c.centre, ns)}, {c.centre, d, b, a}),
      sketch.block({a_b, b_corner, -top_arc, -outwards(a, c.top)}, {a, b, c.corner, c.top}),
      sketch.block({b_d, outwards(d, c.side), -side_arc, -b_corner}, {b, d, c.side, c.corner}),
  };
}
}  // namespace mill::meshes
