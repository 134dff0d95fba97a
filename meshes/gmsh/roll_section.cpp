#include "meshes/gmsh/roll_section.h"
#include "meshes/common/series.h"
#include "meshes/gmsh/section_core.h"
#include <array>
#include <cmath>

namespace mill::meshes {
namespace {
// Ratio of a geometric series of n elements that starts with `first` and fills `length`.  The library of Gmsh and
// deal.II has nothing of the program, core/numerics/root_search included (decision 63).
double growth_filling(const double length, const double first, const int n)
{
  double low = 1e-3, high = 1e3;
  for (int i = 0; i < 200; ++i) {
    const double middle                              = std::sqrt(low * high);
    (sum_of(first, middle, n) < length ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

// The ring of 3:1 templates between three fine edges and one coarse edge: four quadrilaterals each.
//    o0 ------- o1      outer, coarse
//    | a --- b  |
//    i0 i1  i2  i3      inner, fine
void add_template(Sketch &sketch, const std::array<TaggedPoint, 4> &inner, const TaggedPoint &o0,
                  const TaggedPoint &o1, std::vector<int> &surfaces)
{
  const auto between = [](const TaggedPoint &p, const TaggedPoint &q, const double t) {
    return std::array<double, 2>{p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)};
  };
  const auto mid = [&](const TaggedPoint &from, const double along) {
    const auto target = between(o0, o1, along);
    return sketch.point(0.5 * (from.x + target[0]), 0.5 * (from.y + target[1]));
  };
  const TaggedPoint a = mid(inner[1], 1. / 3), b = mid(inner[2], 2. / 3);
  surfaces.push_back(sketch.quad(inner[0], inner[1], a, o0));
  surfaces.push_back(sketch.quad(inner[1], inner[2], b, a));
  surfaces.push_back(sketch.quad(inner[2], inner[3], o1, b));
  surfaces.push_back(sketch.quad(a, b, o1, o0));
}
}  // namespace

SectionSurfaces add_section(const RollGeometry &roll, const SectionSize &s)
{
  Sketch sketch;
  SectionSurfaces out;
  const double R = roll.radius, r = core_radius_of(roll);
  const int nx = s.patch_elements, ny = s.depth_elements;
  const TaggedPoint centre = sketch.point(0, 0);
  const auto on_arc        = [&](const double radius, const double x) {
    return sketch.point(x, std::sqrt(radius * radius - x * x));
  };

  // Box under the contact: patch on the circle, element lines parallel to it.
  const double xb = patch_half_width(s), yb = sum_of(s.first_element, s.depth_growth, ny);
  const TaggedPoint top = sketch.point(0, R), q0 = on_arc(R, xb);
  std::vector<TaggedPoint> below,
      right;  // points of the box boundary, from x = 0 along the bottom, then up the right side
  for (int i = 0; i <= nx; ++i)
    below.push_back(sketch.point(sum_of(s.first_element, s.growth, i), R - yb));
  right.push_back(below.back());
  for (int j = ny - 1; j > 0; --j)
    right.push_back(sketch.point(xb, q0.y - (q0.y - (R - yb)) / yb * sum_of(s.first_element, s.depth_growth, j)));
  right.push_back(q0);
  {
    std::vector<int> boundary;
    for (int i = 0; i < nx; ++i)
      boundary.push_back(sketch.line(below[i], below[i + 1]));
    for (int j = 0; j < ny; ++j)
      boundary.push_back(sketch.line(right[j], right[j + 1]));
    boundary.push_back(-sketch.arc(top, centre, q0, nx, s.growth));
    boundary.push_back(sketch.line(top, below[0], ny, s.depth_growth));
    out.rim.push_back(sketch.block(boundary, {below[0], right[0], q0, top}));
  }

  // Ring of templates: the same rectangle, larger by the size of a coarse element.
  const double edge_x = xb - below[nx - 3].x, edge_y = right[3].y - right[0].y;
  const double t = 0.5 * (edge_x + edge_y), X = xb + t, Y = yb + t;
  std::vector<TaggedPoint> ring_below, ring_right;
  for (int i = 0; i <= nx; i += 3)
    ring_below.push_back(sketch.point(below[i].x * X / xb, R - Y));
  ring_right.push_back(ring_below.back());
  const TaggedPoint q1 = on_arc(R, X);
  for (int j = 3; j < ny; j += 3)
    ring_right.push_back(
        sketch.point(X, R - Y + (right[j].y - right[0].y) * (q1.y - (R - Y)) / (q0.y - right[0].y)));
  ring_right.push_back(q1);
  sketch.arc(q0, centre, q1,
             1);  // the outermost template lies on the circle: make its edge an arc before its line
  for (int i = 0; i < nx / 3; ++i)
    add_template(sketch, {below[3 * i], below[3 * i + 1], below[3 * i + 2], below[3 * i + 3]}, ring_below[i],
                 ring_below[i + 1], out.rim);
  for (int j = 0; j < ny / 3; ++j)
    add_template(sketch, {right[3 * j], right[3 * j + 1], right[3 * j + 2], right[3 * j + 3]}, ring_right[j],
                 ring_right[j + 1], out.rim);

  // Growing grid: from the ring to the core circle and along the outer circle.
  // The straight line from the ring to the core circle must not cut it: on a thick neck it ends nearer to the top.
  const double theta   = std::min(45., 0.8 * std::acos(r / R) * 180 / M_PI);  // degrees from the contact plane
  const TaggedPoint n0 = sketch.point(0, r), n1 = sketch.at_angle(r, theta), n2 = sketch.point(r, 0);
  const TaggedPoint c1 = sketch.at_angle(R, 4. / 3 * theta), c2 = sketch.point(R, 0);
  const TaggedPoint p1 = ring_below.back();
  const double reach   = R - Y - r;
  // A section without room there is refused when it is meshed.
  const int n_far = std::max(
      2, int(std::ceil(std::log1p(std::max(0.0, reach) * (s.far_growth - 1) / t) / std::log(s.far_growth))));
  const auto ratio = [&](const double length) { return growth_filling(length, t, n_far); };
  const int m = nx / 3, k = ny / 3, ns = int(std::ceil(s.sector_elements * (90 - theta) / 45));
  const int left   = sketch.line(ring_below[0], n0, n_far, ratio(reach));
  const int middle = sketch.line(p1, n1, n_far, ratio(std::hypot(n1.x - p1.x, n1.y - p1.y)));
  const int rim = sketch.arc(q1, centre, c1, n_far, ratio(R * (4. / 3 * theta * M_PI / 180 - std::asin(X / R))));
  const int core_a = sketch.arc(n0, centre, n1, m);
  const int core_b = sketch.arc(n1, centre, n2, ns);
  const int spoke  = sketch.line(n1, c1, k);
  {
    std::vector<int> boundary{-left};
    for (int i = 0; i < m; ++i)
      boundary.push_back(sketch.line(ring_below[i], ring_below[i + 1]));
    boundary.push_back(middle);
    boundary.push_back(-core_a);
    out.rim.push_back(sketch.block(boundary, {n0, ring_below[0], p1, n1}));
  }
  {
    std::vector<int> boundary{-middle};
    for (int j = 0; j < k; ++j)
      boundary.push_back(sketch.line(ring_right[j], ring_right[j + 1]));
    boundary.push_back(rim);
    boundary.push_back(-spoke);
    out.rim.push_back(sketch.block(boundary, {n1, p1, q1, c1}));
  }
  out.rim.push_back(
      sketch.block({spoke, sketch.arc(c1, centre, c2, ns), sketch.line(c2, n2, k), -core_b}, {n1, c1, c2, n2}));

  CoreCircle core{centre, n0, n1, n2, theta};
  core.corner_share    = 0.6;
  core.top_elements    = m;
  core.side_elements   = ns;
  core.radial_elements = std::max(1, ns / 2);
  out.core             = add_core(sketch, roll, core);
  return out;
}
}  // namespace mill::meshes
