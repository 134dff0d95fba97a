#include "meshes/gmsh/roll_section.h"
#include <algorithm>
#include <cmath>
#include <gmsh.h>

namespace mill::meshes {
namespace geo = gmsh::model::geo;

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
  const Graded core = graded_from_edge(0.5 * r, R / e), rim = graded_from_edge(R - r, R / e);
  // Elements of each eighth of the circle.  The edge of the neck is an arc, its line inside the barrel a polygon:
  // the height of the arc over the chord must stay well below the first element beside it.
  const double first = std::min(core.first, rim.first);
  const int sector =
      std::max({2, int(std::lround(0.6 * e)), int(std::ceil(M_PI / 8 * std::sqrt(r / (0.6 * first))))});

  const auto at = [](const double radius, const double degrees) {
    const double phi = degrees * M_PI / 180;
    return geo::addPoint(radius * std::sin(phi), radius * std::cos(phi), 0);
  };
  // Corners 0.5 r on the axes and 0.62 r on the diagonal: all angles of the five blocks are near 90 degrees.
  const int centre = geo::addPoint(0, 0, 0), a = at(0.5 * r, 0), b = at(0.62 * r, 45), d = at(0.5 * r, 90);
  const int n0 = at(r, 0), n1 = at(r, 45), n2 = at(r, 90), c0 = at(R, 0), c1 = at(R, 45), c2 = at(R, 90);
  const auto divided = [](const int curve, const int elements, const double ratio = 1) {
    geo::mesh::setTransfiniteCurve(curve, elements + 1, "Progression", ratio);
    return curve;
  };
  const auto line = [&](const int from, const int to, const int elements, const double ratio = 1) {
    return divided(geo::addLine(from, to), elements, ratio);
  };
  const auto arc = [&](const int from, const int to) {
    return divided(geo::addCircleArc(from, centre, to), sector);
  };
  const auto block = [](const std::vector<int> &boundary, const std::vector<int> &corners) {
    const int surface = geo::addPlaneSurface({geo::addCurveLoop(boundary)});
    geo::mesh::setTransfiniteSurface(surface, "Left", corners);
    geo::mesh::setRecombine(2, surface);
    return surface;
  };
  const int centre_d = line(centre, d, sector), d_b = line(d, b, sector), b_a = line(b, a, sector);
  const int a_centre = line(a, centre, sector);
  const int a_n0 = line(a, n0, core.n, 1 / core.ratio), b_n1 = line(b, n1, core.n, 1 / core.ratio),
            d_n2  = line(d, n2, core.n, 1 / core.ratio);
  const int n0_c0 = line(n0, c0, rim.n, rim.ratio), n1_c1 = line(n1, c1, rim.n, rim.ratio),
            n2_c2 = line(n2, c2, rim.n, rim.ratio);
  const int n0_n1 = arc(n0, n1), n1_n2 = arc(n1, n2), c0_c1 = arc(c0, c1), c1_c2 = arc(c1, c2);
  SectionSurfaces out;
  out.core.push_back(block({centre_d, d_b, b_a, a_centre}, {centre, d, b, a}));
  out.core.push_back(block({-b_a, b_n1, -n0_n1, -a_n0}, {a, b, n1, n0}));
  out.core.push_back(block({-d_b, d_n2, -n1_n2, -b_n1}, {b, d, n2, n1}));
  out.rim.push_back(block({n0_n1, n1_c1, -c0_c1, -n0_c0}, {n0, n1, c1, c0}));
  out.rim.push_back(block({n1_n2, n2_c2, -c1_c2, -n1_c1}, {n1, n2, c2, c1}));
  return out;
}
}  // namespace mill::meshes
