#include "verify/peer_models.h"
#include <algorithm>
#include <cmath>

namespace mill::verify::peer {
namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d between(const Vector2d &a, const Vector2d &b, const double t)
{
  return (1 - t) * a + t * b;
}

Vector2d on_circle(const double radius, const double angle)
{
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

// A block of the section, drawn out along z over [from, to].
using Section = std::function<Vector2d(double, double)>;
void extrude(Mesh &mesh, const std::vector<double> &u, const std::vector<double> &v, const Section &section,
             const double from, const double to, const int layers)
{
  add_block(mesh, u, v, even(layers), [&](const double a, const double b, const double c) {
    const Vector2d p = section(a, b);
    return Vector3d(p[0], p[1], from + c * (to - from));
  });
}

int count(const double length, const double size)
{
  return std::max(1, int(std::ceil(length / size - 1e-9)));
}
}  // namespace

Mesh roll_eighth(const RollGeometry &roll, const int n)
{
  const double r = roll.neck_radius, R = roll.radius, size = r / n, eighth = M_PI / 4;
  // A square with bent-out corner in the middle of the neck, two blocks around it, the barrel's ring around these.
  const Vector2d along_x(0.5 * r, 0), along_y(0, 0.5 * r), corner(0.4 * r, 0.4 * r);
  const auto neck_section = [&](Mesh &mesh, const double from, const double to, const int layers) {
    const auto lines = even(n);
    extrude(
        mesh, lines, lines,
        [&](const double a, const double b) {
          return between(between(Vector2d::Zero(), along_x, a), between(along_y, corner, a), b);
        },
        from, to, layers);
    extrude(
        mesh, lines, lines,
        [&](const double a, const double b) {
          return between(between(along_x, corner, b), on_circle(r, eighth * b), a);
        },
        from, to, layers);
    extrude(
        mesh, lines, lines,
        [&](const double a, const double b) {
          return between(between(corner, along_y, b), on_circle(r, eighth * (1 + b)), a);
        },
        from, to, layers);
  };
  const double h = roll.half_length, end = h + roll.neck_length;
  const double seat = roll.seat_centre - std::min(0.5 * roll.neck_length, end - roll.seat_centre);
  Mesh mesh;
  const int barrel = count(h, size);
  neck_section(mesh, 0, h, barrel);
  extrude(
      mesh, even(count(R - r, size)), even(2 * n),
      [&](const double a, const double b) { return on_circle(r + a * (R - r), 2 * eighth * b); }, 0, h, barrel);
  if (seat - h > 1e-6 * r)  // a line where the seat begins
    neck_section(mesh, h, seat, count(seat - h, size));
  neck_section(mesh, std::max(seat, h), end, count(end - std::max(seat, h), size));
  return mesh;
}

namespace {
// From the middle of a beam through its corner, as if the beam lay above y = 0 and the window below it; `place`
// puts the section into the housing.
void beam_and_corner(Mesh &mesh, const MillHousing &h, const double height, const double pad, const int n,
                     const std::vector<double> &z, const std::function<Vector2d(Vector2d)> &place)
{
  const double r = h.fillet_radius, flat = 0.5 * h.window_width - r, out = 0.5 * h.window_width + h.post_width;
  const double size = h.post_width / n;
  const auto block  = [&](const int n_a, const Section &section) {
    for (std::size_t k = 0; k + 1 < z.size(); ++k)
      extrude(
           mesh, even(n_a), even(n), [&](const double a, const double b) { return place(section(a, b)); }, z[k],
           z[k + 1], count(z[k + 1] - z[k], size));
  };
  const auto beam = [&](const double from, const double to) {
    if (to - from > 1e-6 * flat)
      block(count(to - from, size),
            [&](const double a, const double b) { return Vector2d(from + a * (to - from), b * height); });
  };
  beam(0, 0.5 * pad);
  beam(0.5 * pad, flat);
  const auto fillet = [&](const double angle) {  // 0 at the beam, pi/2 at the post
    return Vector2d(flat + r * std::sin(angle), r * (std::cos(angle) - 1));
  };
  const Vector2d above(flat, height), corner(out, height), beside(out, -r);
  const int bend = count(h.post_width, size) / 2 + 1;
  block(bend, [&](const double a, const double b) {
    return between(fillet(0.25 * M_PI * a), between(above, corner, a), b);
  });
  block(bend, [&](const double a, const double b) {
    return between(fillet(0.25 * M_PI * (1 + a)), between(corner, beside, a), b);
  });
}
}  // namespace

Mesh housing_quarter(const MillHousing &h, const int n)
{
  std::vector<double> z{0};
  std::vector<double> ends{0.5 * h.seat_pad, 0.5 * h.screw_pad, 0.5 * h.thickness};
  std::sort(ends.begin(), ends.end());
  for (const double end : ends)
    if (end - z.back() > 1e-6 * h.thickness)
      z.push_back(end);
  Mesh mesh;
  beam_and_corner(mesh, h, h.upper_beam_height, h.screw_pad, n, z,
                  [&](const Vector2d &p) { return Vector2d(p[0], h.window_height + p[1]); });
  beam_and_corner(mesh, h, h.lower_beam_height, h.seat_pad, n, z,
                  [](const Vector2d &p) { return Vector2d(p[0], -p[1]); });
  const double a = 0.5 * h.window_width, low = h.fillet_radius, high = h.window_height - h.fillet_radius;
  for (std::size_t k = 0; k + 1 < z.size(); ++k)
    extrude(
        mesh, even(n), even(count(high - low, h.post_width / n)),
        [&](const double u, const double v) { return Vector2d(a + u * h.post_width, low + v * (high - low)); },
        z[k], z[k + 1], count(z[k + 1] - z[k], h.post_width / n));
  return mesh;
}
}  // namespace mill::verify::peer
