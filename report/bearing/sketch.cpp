#include "report/bearing/figures.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <cmath>

namespace mill::report {
namespace {
using Eigen::Vector2d;

// Millimetres of the section to px; z along the axis, r from it, drawn upwards.
struct Section {
  double scale, z0, r0;  // px/mm, px of z = 0, px of r = 0
  Vector2d operator()(const double z, const double r) const
  {
    return {z0 + scale * z, r0 - scale * r};
  }
};

struct Size {
  double bore, outside, width, pitch, length, roller, angle, cone;  // mm, rad
  int rows, rollers;
};

bool read(const BearingInfo &bearing, Size &size)
{
  const auto mm     = [&](const char *key) { return 1e3 * bearing(key); };
  const double rows = bearing("rows"), rollers = bearing("rollers_per_row");
  if (!(rows >= 1 && rows <= 100 && rollers >= 1 && rollers <= 1000))
    return false;  // a damaged run.json: a loop over what it says might not end
  size = {mm("bore"),           mm("outside_diameter"),       mm("width"),
          mm("pitch_diameter"), mm("roller_length"),          mm("roller_diameter"),
          bearing("cup_angle"), bearing("roller_cone_angle"), int(rows),
          int(rollers)};
  if (!(size.pitch > 0))
    size.pitch = 0.5 * (size.bore + size.outside);
  return size.bore > 0 && size.outside > size.bore && size.width > 0 && size.length > 0 && size.roller > 0 &&
         size.angle >= 0 && size.cone >= 0;
}

// One row: the roller between the raceways that follow it.  Hand +1 carries towards +z: its contact normal points
// outwards and to +z, so the small end is there.
void draw_row(Svg &svg, const Section &section, const Size &s, const double z, const double hand,
              const double half_pitch)
{
  const double axis = s.angle - s.cone / 2;  // of the roller
  const auto corner = [&](const double along, const double side) {
    const double radius = s.roller / 2 - along * std::tan(s.cone / 2);  // thinner towards the small end
    const double dz     = along * std::cos(axis) + side * radius * std::sin(axis);
    const double dr     = -along * std::sin(axis) + side * radius * std::cos(axis);
    return Vector2d(z + hand * dz, s.pitch / 2 + dr);
  };
  const auto px          = [&](const Vector2d &p) { return section(p[0], p[1]); };
  const double half      = s.length / 2;
  const Vector2d big_out = corner(-half, 1), small_out = corner(half, 1), big_in = corner(-half, -1),
                 small_in = corner(half, -1);
  // A raceway goes on a little beyond its roller; from there to the edge of the row the ring is cylindrical.
  const double reach = std::min(0.56 * s.length * std::cos(axis), half_pitch);
  const auto raceway = [&](const Vector2d &big, const Vector2d &small, const double back) {
    const double slope = (small[1] - big[1]) / (small[0] - big[0]), middle = 0.5 * (small[1] + big[1]);
    const double left = middle - slope * reach, right = middle + slope * reach;
    svg.polyline({section(z - half_pitch, back), section(z - half_pitch, left), section(z - reach, left),
                  section(z + reach, right), section(z + half_pitch, right), section(z + half_pitch, back)},
                 "ring-steel", true);
  };
  raceway(big_out, small_out, s.outside / 2);
  raceway(big_in, small_in, s.bore / 2);
  svg.polyline({px(big_out), px(small_out), px(small_in), px(big_in)}, "roller", true);
  const Vector2d a = section(z - hand * 0.62 * s.length * std::cos(axis),
                             s.pitch / 2 + 0.62 * s.length * std::sin(axis)),
                 b = section(z + hand * 0.62 * s.length * std::cos(axis),
                             s.pitch / 2 - 0.62 * s.length * std::sin(axis));
  svg.line(a[0], a[1], b[0], b[1], "centreline");
}

void draw_dimension(Svg &svg, const double x1, const double x2, const double y, const std::string &label)
{
  svg.line(x1, y, x2, y, "dimension");
  for (const double x : {x1, x2})
    svg.line(x, y - 4, x, y + 4, "dimension");
  svg.text((x1 + x2) / 2, y - 5, label, "t halo", Anchor::middle);
}

std::string along_the_axis(const BearingInfo &bearing, const Size &s)
{
  const double tall = 0.5 * (s.outside - s.bore), scale = std::min(540 / s.width, 150 / tall);  // px/mm
  const double neck = 34, chock = 40;                                                           // px, cut off
  const Section section{scale, 320, 96 + scale * s.outside / 2};
  Svg svg(640, 96 + scale * tall + 110, "section along the axis of the bearing, lengths in mm");
  svg.text(20, 15, "Along the axis", "title");
  const double left = section.z0 - scale * s.width / 2, right = section.z0 + scale * s.width / 2;
  const double outer = section(0, s.outside / 2)[1], inner = section(0, s.bore / 2)[1];
  svg.rect(left - 12, outer - chock, right - left + 24, chock, "steel");
  svg.text(section.z0, outer - chock / 2 + 4, "chock", "t", Anchor::middle);
  svg.rect(left - 30, inner, right - left + 60, neck, "steel");
  svg.text(section.z0, inner + neck / 2 + 4, "roll neck", "t", Anchor::middle);
  const double pitch = s.width / s.rows;
  for (int row = 0; row < s.rows; ++row) {
    const double hand =
        bearing.hands.empty() || bearing.hands[std::size_t(row) % bearing.hands.size()] == '+' ? 1 : -1;
    draw_row(svg, section, s, (row + 0.5) * pitch - s.width / 2, hand, pitch / 2);
    svg.text(section((row + 0.5) * pitch - s.width / 2, 0)[0], outer - chock - 8, "row " + std::to_string(row + 1),
             "t", Anchor::middle);
  }
  draw_dimension(svg, left, right, inner + neck + 24, "width " + significant(s.width, 6));
  svg.text(left - 6, outer + 4, "\u2300 " + significant(s.outside, 4), "t halo", Anchor::end);
  svg.text(left - 6, inner + 4, "\u2300 " + significant(s.bore, 4), "t halo", Anchor::end);
  svg.text(section.z0, inner + neck + 48,
           std::to_string(s.rows) + " \u00d7 " + std::to_string(s.rollers) + " rollers " +
               significant(s.length, 4) + " \u00d7 \u2300 " + significant(s.roller, 4) + ", cup angle " +
               fixed(s.angle * 180 / EIGEN_PI, 2) + "\u00b0",
           "t", Anchor::middle);
  svg.text(section.z0, inner + neck + 68, "lengths [mm], to scale", "axis", Anchor::middle);
  return svg.str();
}

std::string across_the_axis(const BearingInfo &bearing, const Size &s)
{
  const double chock_width  = bearing("chock_width") > 0 ? 1e3 * bearing("chock_width") : 1.7 * s.outside;
  const double chock_height = bearing("chock_height") > 0 ? 1e3 * bearing("chock_height") : 1.6 * s.outside;
  const double support =
      bearing("chock_support_width") > 0 ? 1e3 * bearing("chock_support_width") : 0.5 * chock_width;
  const double gap   = bearing("chock_support_gap") > 0 ? 1e3 * bearing("chock_support_gap") : 0;
  const double scale = std::min(330 / chock_width, 270 / chock_height), x = 190, y = 40 + scale * chock_height / 2;
  Svg svg(380, 40 + scale * chock_height + 66, "section across the axis of the bearing, lengths in mm");
  svg.text(20, 15, "Across the axis", "title");
  svg.rect(x - scale * chock_width / 2, y - scale * chock_height / 2, scale * chock_width, scale * chock_height,
           "steel");
  svg.circle(x, y, scale * s.outside / 2, "ring-steel");
  svg.circle(x, y, scale * (s.pitch + s.roller) / 2, "bearing");
  svg.circle(x, y, scale * (s.pitch - s.roller) / 2, "ring-steel");
  svg.circle(x, y, scale * s.bore / 2, "steel");
  for (int j = 0; j < s.rollers; ++j) {
    const double psi = 2 * EIGEN_PI * j / s.rollers, r = scale * s.pitch / 2;
    svg.circle(x + r * std::sin(psi), y + r * std::cos(psi), scale * s.roller / 2, "roller");
  }
  const double bottom = y + scale * chock_height / 2;
  // What carries the chock: one face, or two feet.
  std::vector<std::pair<double, double>> feet{{-support / 2, support / 2}};
  if (gap > 0 && gap < support)
    feet = {{-support / 2, -gap / 2}, {gap / 2, support / 2}};
  for (const auto &[from, to] : feet) {
    svg.line(x + scale * from, bottom + 3, x + scale * to, bottom + 3, "spring");
    for (double position = x + scale * from; position < x + scale * to - 8; position += 24)
      svg.line(position, bottom + 12, position + 9, bottom + 3, "dimension");
  }
  svg.line(x, y - 26, x, y + 16, "arrow");
  svg.polyline({{x, y + 26}, {x - 6, y + 14}, {x + 6, y + 14}}, "arrowhead", true);
  svg.text(x + 10, y - 14, "load", "t halo");
  svg.text(x, bottom + 28,
           "chock " + significant(chock_width, 4) + " \u00d7 " + significant(chock_height, 4) + ", carried over " +
               significant(support, 4) + (gap > 0 ? " but its middle " + significant(gap, 4) : ""),
           "t", Anchor::middle);
  svg.text(x, bottom + 48, "lengths [mm], to scale", "axis", Anchor::middle);
  return svg.str();
}
}  // namespace

std::vector<std::string> bearing_sketch(const BearingInfo &bearing)
{
  Size size{};
  if (!read(bearing, size))
    return {};
  return {along_the_axis(bearing, size), across_the_axis(bearing, size)};
}
}  // namespace mill::report
