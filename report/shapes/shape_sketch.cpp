#include "report/shapes/shape_sketch.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
void draw_arrows(Svg &svg, const double left, const double right, const double from, const double to)
{
  const int n      = std::max(2, int((right - left) / 26));
  const double tip = to > from ? -6 : 6;
  svg.line(left, from, right, from, "arrow-line");
  for (int i = 0; i <= n; ++i) {
    const double x = left + (right - left) * i / n;
    svg.line(x, from, x, to + tip, "arrow-line");
    svg.polyline({{x, to}, {x - 3, to + tip}, {x + 3, to + tip}}, "arrowhead", true);
  }
}

// An elastic foundation that holds: short strokes on the side away from the roll.
void draw_foundation(Svg &svg, const double left, const double right, const double y, const double away)
{
  svg.line(left, y, right, y, "ground-line");
  for (double x = left; x + 8 <= right + 1; x += 8)
    svg.line(x, y + away, x + 8, y, "dimension");
}
}  // namespace

std::string roll_sketch(const RollSketch &s)
{
  if (!std::isfinite(s.half_barrel + s.radius + s.neck_radius + s.half_total))
    return "";
  const double scale  = (s.right - s.left) / (s.high - s.low);  // px/m, the same up and down
  const auto to_x     = [&](const double x) { return s.left + (x - s.low) * scale; };
  const double radius = s.radius * scale, neck = s.neck_radius * scale;
  const double axis = 58 + radius, bottom = axis + radius;
  const bool seats = std::isfinite(s.half_seat), contact = std::isfinite(s.half_contact);
  Svg svg(s.width, bottom + 84, s.title + ", to scale in m");
  svg.text(34, 15, s.title, "t strong");
  svg.rect(to_x(-s.half_total), axis - neck, 2 * s.half_total * scale, 2 * neck, "steel");
  svg.rect(to_x(-s.half_barrel), axis - radius, 2 * s.half_barrel * scale, 2 * radius, "steel");
  svg.line(std::max(s.left, to_x(-s.half_total) - 8), axis, std::min(s.right, to_x(s.half_total) + 8), axis,
           "centreline");
  // Drawn as the upper rolls: the strip pushes up, what holds them is above.
  if (seats)
    for (const double side : {-1.0, 1.0}) {
      const double x = to_x(side * s.half_seat), y = axis - neck;
      if (s.work) {  // carries no load here, only its chock's mass
        svg.rect(x - 6, axis - 1.3 * neck, 12, 2.6 * neck, "bearing");
        continue;
      }
      svg.polyline({{x, y}, {x - 9, y - 14}, {x + 9, y - 14}}, "support", true);
      svg.line(x - 14, y - 14, x + 14, y - 14, "ground-line");
    }
  if (contact && s.work) {
    draw_foundation(svg, to_x(-s.half_contact), to_x(s.half_contact), axis - radius, -8);
    svg.text(to_x(0), axis - radius - 13, "contact line: springs of K3 or K5 over the barrel", "t halo",
             Anchor::middle);
  } else if (contact) {
    draw_arrows(svg, to_x(-s.half_contact), to_x(s.half_contact), bottom + 20, bottom);
    svg.text(to_x(0), bottom + 34, "contact line with the work roll", "t halo", Anchor::middle);
  }
  if (s.work && std::isfinite(s.half_strip)) {
    draw_arrows(svg, to_x(-s.half_strip), to_x(s.half_strip), bottom + 20, bottom);
    svg.text(to_x(0), bottom + 34, "strip width", "t halo", Anchor::middle);
  }
  if (seats)
    svg.text(to_x(-s.half_seat), s.work ? axis + 1.3 * neck + 15 : axis - neck - 20, s.work ? "chock" : "bearing",
             "t halo", Anchor::middle);
  svg.text((s.left + s.right) / 2, bottom + 66, "roll to scale, along the axis of the diagram above [m]", "axis",
           Anchor::middle);
  return svg.str();
}
}  // namespace mill::report
