#include "meshes/gmsh/roll_section.h"
#include "meshes/gmsh/section_core.h"
#include <algorithm>
#include <cmath>

namespace mill::meshes {
namespace {
// Elements along a line whose first ones are short: at the shoulder's reentrant edge the stress has no limit.
struct Graded {
  int n        = 1;
  double ratio = 1;  // -, of one element to the one before
  double first = 0;  // m
};
Graded graded_from_edge(const double length, const double largest)
{
  constexpr double last_to_first = 4;
  Graded g;
  g.first = length;
  if (length < 0.25 * largest)  // the shoulder is lower than the first element would be
    return g;
  g.n        = int(std::ceil(length / largest - 1e-9)) + 1;
  g.ratio    = std::pow(last_to_first, 1. / (g.n - 1));
  double sum = 0;
  for (int i = 0; i < g.n; ++i)
    sum += std::pow(g.ratio, i);
  g.first = length / sum;
  return g;
}
}  // namespace

SectionSurfaces add_plain_section(const RollGeometry &roll, const int elements_per_radius)
{
  const double R = roll.radius, r = core_radius_of(roll), e = elements_per_radius;
  const Graded inner = graded_from_edge(core_depth(roll), R / e), rim = graded_from_edge(R - r, R / e);
  // Elements of each eighth of the circle.  The edge of the neck is an arc, its line inside the barrel a polygon:
  // the height of the arc over the chord must stay well below the first element next to it.
  const double first = std::min(inner.first, rim.first);
  const int sector =
      std::max({2, int(std::lround(0.6 * e)), int(std::ceil(M_PI / 8 * std::sqrt(r / (0.6 * first))))});

  Sketch sketch;
  CoreCircle core;
  core.centre          = sketch.point(0, 0);
  core.top             = sketch.at_angle(r, 0);
  core.corner          = sketch.at_angle(r, 45);
  core.side            = sketch.at_angle(r, 90);
  core.corner_share    = 0.62;  // with 0.5 on the axes all angles of the five blocks are near 90 degrees
  core.top_elements    = sector;
  core.side_elements   = sector;
  core.radial_elements = inner.n;
  core.radial_ratio    = 1 / inner.ratio;
  SectionSurfaces out;
  out.core = add_core(sketch, roll, core);

  const TaggedPoint c0 = sketch.at_angle(R, 0), c1 = sketch.at_angle(R, 45), c2 = sketch.at_angle(R, 90);
  const auto outwards = [&](const TaggedPoint &from, const TaggedPoint &to) {
    return sketch.line(from, to, rim.n, rim.ratio);
  };
  const auto rim_block = [&](const TaggedPoint &n0, const TaggedPoint &n1, const TaggedPoint &from,
                             const TaggedPoint &to) {
    const auto arc = [&](const TaggedPoint &p, const TaggedPoint &q) {
      return sketch.arc(p, core.centre, q, sector);
    };
    return sketch.block({arc(n0, n1), outwards(n1, to), -arc(from, to), -outwards(n0, from)}, {n0, n1, to, from});
  };
  out.rim = {rim_block(core.top, core.corner, c0, c1), rim_block(core.corner, core.side, c1, c2)};
  return out;
}
}  // namespace mill::meshes
