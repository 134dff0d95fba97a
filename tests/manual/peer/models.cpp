#include "tests/manual/peer/models.h"
#include "core/model/roll.h"
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

// A block of the section, drawn out along the lines z (m).
using Section = std::function<Vector2d(double, double)>;
void extrude(Mesh &mesh, const std::vector<double> &u, const std::vector<double> &v, const Section &section,
             const std::vector<double> &z)
{
  add_block(mesh, u, v, z, [&](const double a, const double b, const double c) {
    const Vector2d p = section(a, b);
    return Vector3d(p[0], p[1], c);
  });
}

std::vector<double> even_between(const double from, const double to, const int n)
{
  std::vector<double> lines = even(n);
  for (double &line : lines)
    line = from + line * (to - from);
  return lines;
}

// Lines crowded at `at`: distances grow with the square, from there to `to`.
std::vector<double> crowded(const double position, const double to, const int n)
{
  std::vector<double> lines = even(n);
  for (double &line : lines)
    line = position + line * line * (to - position);
  std::sort(lines.begin(), lines.end());
  return lines;
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
  const auto across = even(n), outwards = crowded(1, 0, n);
  const auto neck_section = [&](Mesh &mesh, const std::vector<double> &z) {
    extrude(
        mesh, across, across,
        [&](const double a, const double b) {
          return between(between(Vector2d::Zero(), along_x, a), between(along_y, corner, a), b);
        },
        z);
    extrude(
        mesh, outwards, across,
        [&](const double a, const double b) {
          return between(between(along_x, corner, b), on_circle(r, eighth * b), a);
        },
        z);
    extrude(
        mesh, outwards, across,
        [&](const double a, const double b) {
          return between(between(corner, along_y, b), on_circle(r, eighth * (1 + b)), a);
        },
        z);
  };
  const double h = roll.half_length, end = h + roll.neck_length;
  const double seat = roll.seat_centre - std::min(0.5 * roll.neck_length, end - roll.seat_centre);
  const auto barrel = crowded(h, 0, count(h, size));
  auto neck         = crowded(h, end, count(end - h, size));
  if (seat - h > 1e-6 * r)  // the line next to where the seat begins
    *std::min_element(neck.begin() + 1, neck.end() - 1, [=](const double a, const double b) {
      return std::abs(a - seat) < std::abs(b - seat);
    }) = seat;
  Mesh mesh;
  neck_section(mesh, barrel);
  neck_section(mesh, neck);
  extrude(
      mesh, crowded(0, 1, std::max(2, count(R - r, size))), even(2 * n),
      [&](const double a, const double b) { return on_circle(r + a * (R - r), 2 * eighth * b); }, barrel);
  return mesh;
}

namespace {
// The quarter y >= 0 of a disc (side 1) or its mirror image below (side -1).
void add_disc_quarter(Mesh &mesh, const DiscSection &d, const std::vector<double> &z, const double side)
{
  const double R = d.radius, eighth = M_PI / 4, first = d.half_width / d.n;
  const Vector2d along_x(0.5 * R, 0), along_y(0, 0.5 * R), corner(0.4 * R, 0.4 * R);
  const int fine      = 3 * d.n / 2;
  const auto around   = towards_end(first / (eighth * R), fine, d.growth),
             outwards = towards_end(first / (0.5 * R), fine, d.growth);
  std::vector<double> backwards;  // the same lines from the other side
  for (auto line = around.rbegin(); line != around.rend(); ++line)
    backwards.push_back(1 - *line);
  const auto coarse = even(4);
  const auto block  = [&](const std::vector<double> &u, const std::vector<double> &v, const Section &section) {
    extrude(
         mesh, u, v,
         [&](const double a, const double b) {
          const Vector2d p = section(a, b);
          return Vector2d(p[0], side * p[1]);
        },
         z);
  };
  block(backwards, coarse, [&](const double a, const double b) {
    return between(between(Vector2d::Zero(), along_x, a), between(along_y, corner, a), b);
  });
  block(outwards, coarse, [&](const double a, const double b) {
    return between(between(along_x, corner, b), on_circle(R, eighth * b), a);
  });
  block(outwards, around, [&](const double a, const double b) {
    return between(between(corner, along_y, b), on_circle(R, eighth * (1 + b)), a);
  });
}
}  // namespace

Mesh disc_quarter(const DiscSection &section, const std::vector<double> &z)
{
  Mesh mesh;
  add_disc_quarter(mesh, section, z, 1);
  return mesh;
}

Mesh disc_half(const DiscSection &section, const std::vector<double> &z)
{
  Mesh mesh;
  add_disc_quarter(mesh, section, z, 1);
  add_disc_quarter(mesh, section, z, -1);
  return mesh;
}

Mesh raceway_quarter(const RacewayBlock &r)
{
  Mesh mesh;
  add_block(mesh, r.x, r.depth, r.z, [&](const double x, const double depth, const double z) {
    const double angle = std::asin(x / r.radius), from_centre = r.radius - depth;
    return Vector3d(from_centre * std::sin(angle), from_centre * std::cos(angle) - r.radius, z);
  });
  return mesh;
}

std::vector<double> growing_lines(const double length, const double first, const int n, const double growth)
{
  std::vector<double> lines;
  const auto crowded_at_end = towards_end(first / length, n, growth);
  for (auto line = crowded_at_end.rbegin(); line != crowded_at_end.rend(); ++line)
    lines.push_back((1 - *line) * length);
  return lines;
}

Mesh moved(Mesh body, const std::function<Vector3d(const Vector3d &)> &place)
{
  for (Vector3d &p : body.nodes)
    p = place(p);
  return body;
}

Mesh turned_over(Mesh body, const double y)
{
  body = moved(std::move(body), [=](const Vector3d &p) { return Vector3d(p[0], y - p[1], p[2]); });
  for (auto &element : body.elements) {  // a mirror image: bottom and top change places
    std::rotate(element.begin(), element.begin() + 4, element.begin() + 8);
    std::rotate(element.begin() + 8, element.begin() + 12, element.begin() + 16);
  }
  return body;
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
           mesh, even(n_a), even(n), [&](const double a, const double b) { return place(section(a, b)); },
           even_between(z[k], z[k + 1], count(z[k + 1] - z[k], size)));
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
  const Vector2d above(flat, height), corner(out, height), below(out, -r);
  const int bend = count(h.post_width, size) / 2 + 1;
  block(bend, [&](const double a, const double b) {
    return between(fillet(0.25 * M_PI * a), between(above, corner, a), b);
  });
  block(bend, [&](const double a, const double b) {
    return between(fillet(0.25 * M_PI * (1 + a)), between(corner, below, a), b);
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
        even_between(z[k], z[k + 1], count(z[k + 1] - z[k], h.post_width / n)));
  return mesh;
}
}  // namespace mill::verify::peer
