// The stand as the case draws it: seen along the rolling direction, and along the rolls where a housing is drawn.
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
constexpr double view_height = 440, view_gap = 34, view_foot = 52;  // px

/// Sizes of the stand in m; 0 where the case does not draw it.
class Sizes {
public:
  explicit Sizes(const Run &run) : length_(run.manifest.geometry) {}
  double operator()(const std::string &name) const
  {
    const auto match = length_.find(name);
    return match == length_.end() || !(match->second > 0) ? 0 : match->second;
  }

private:
  const std::map<std::string, double> &length_;
};

/// Heights in m above the pass line, up.
struct Heights {
  double work, backup;               // axes of the upper rolls; the lower ones are mirrored
  double window_top, window_bottom;  // of the housing's window; equal without a housing
  double top, bottom;                // of the drawing
};

// Where no chock is drawn it is as high as the neck and half of it.
double chock_height(const Sizes &size)
{
  return 1.5 * size("backup_neck_diameter");
}

Heights heights_of(const Sizes &size)
{
  Heights h;
  h.work          = 0.5 * size("work_roll_diameter");
  h.backup        = size("work_roll_diameter") + 0.5 * size("backup_diameter");
  h.top           = h.backup + 0.5 * size("backup_diameter");
  h.bottom        = -h.top;
  h.window_bottom = h.window_top = 0;
  if (size("housing_window_height") > 0) {
    h.window_bottom = -h.backup - 0.5 * std::max(chock_height(size), size("backup_diameter") * 0.9);
    h.window_top    = h.window_bottom + size("housing_window_height");
    h.top           = std::max(h.top, h.window_top + size("housing_upper_beam_height"));
    h.bottom        = std::min(h.bottom, h.window_bottom - size("housing_lower_beam_height"));
  }
  return h;
}

/// One view: a scale and where its middle and the pass line stand.
struct View {
  Svg &svg;
  double scale, x, y;  // px/m, px, px
  void box(const double left, const double bottom, const double width, const double height,
           const char *classes) const
  {
    if (width > 0 && height > 0)
      svg.rect(x + scale * left, y - scale * (bottom + height), scale * width, scale * height, classes);
  }
  void disc(const double height, const double diameter, const char *classes) const
  {
    svg.circle(x, y - scale * height, 0.5 * scale * diameter, classes);
  }
};

double half_length(const Sizes &size)  // along the rolls
{
  return std::max({0.5 * size("work_total_length"), 0.5 * size("backup_length") + size("backup_neck_length"),
                   0.5 * (size("backup_bearing_span") + size("housing_thickness"))});
}

// Nut, screw, load cell and piston hang from the upper beam; what is not drawn is left out.
void draw_screwdown(const View &view, const Sizes &size, const Heights &heights, const double middle)
{
  const auto part = [&](const double top, const double diameter, const double height, const char *classes) {
    view.box(middle - 0.5 * diameter, top - height, diameter, height, classes);
    return diameter > 0 && height > 0 ? top - height : top;
  };
  part(heights.window_top + size("nut_height"), size("nut_outside_diameter"), size("nut_height"), "ring-steel");
  double below = part(heights.window_top, size("screw_diameter"), size("screw_length"), "roller");
  below        = part(below, size("load_cell_diameter"), size("load_cell_height"), "bearing");
  part(below, size("piston_diameter"), size("piston_length") + size("stroke"), "ring-steel");
}

void draw_roll_pair(const View &view, const double axis, const double barrel, const double diameter,
                    const double end, const double neck)
{
  for (const double side : {-1.0, 1.0}) {
    view.box(-end, side * axis - 0.5 * neck, 2 * end, neck, "steel");
    view.box(-0.5 * barrel, side * axis - 0.5 * diameter, barrel, diameter, "steel");
    view.svg.line(view.x - view.scale * end - 6, view.y - view.scale * side * axis, view.x + view.scale * end + 6,
                  view.y - view.scale * side * axis, "centreline");
  }
}

void draw_along_rolling(const View &view, const Sizes &size, const Heights &heights)
{
  const double span = size("backup_bearing_span"), thick = size("housing_thickness");
  for (const double side : {-0.5, 0.5}) {
    view.box(side * span - 0.5 * thick, heights.bottom, thick, heights.top - heights.bottom, "part");
    if (heights.window_top > heights.window_bottom)
      draw_screwdown(view, size, heights, side * span);
  }
  draw_roll_pair(view, heights.backup, size("backup_length"), size("backup_diameter"),
                 0.5 * size("backup_length") + size("backup_neck_length"), size("backup_neck_diameter"));
  draw_roll_pair(view, heights.work, size("work_roll_length"), size("work_roll_diameter"),
                 0.5 * size("work_total_length"), size("work_neck_diameter"));
  for (const auto &[axis, bearings, neck] :
       {std::tuple(heights.backup, span, size("backup_neck_diameter")),
        std::tuple(heights.work, size("work_bearing_span"), size("work_neck_diameter"))})
    for (const double side : {-0.5, 0.5})
      for (const double up : {-1.0, 1.0})
        view.box(side * bearings - 0.225 * neck, up * axis - 0.65 * neck, 0.45 * neck, 1.3 * neck, "bearing");
  const double strip = size("strip_width");
  view.svg.rect(view.x - 0.5 * view.scale * strip, view.y - 1.5, view.scale * strip, 3, "strip");
}

void draw_along_rolls(const View &view, const Sizes &size, const Heights &heights)
{
  const double window = size("housing_window_width"), post = size("housing_post_width");
  const double tall = heights.top - heights.bottom;
  view.box(-0.5 * window - post, heights.bottom, window + 2 * post, tall, "part");
  view.box(-0.5 * window, heights.window_bottom, window, heights.window_top - heights.window_bottom, "window");
  draw_screwdown(view, size, heights, 0);
  for (const double up : {-1.0, 1.0}) {
    view.disc(up * heights.backup, size("backup_diameter"), "steel");
    view.disc(up * heights.backup, size("backup_neck_diameter"), "bearing");
    view.disc(up * heights.work, size("work_roll_diameter"), "steel");
    view.disc(up * heights.work, size("work_neck_diameter"), "bearing");
  }
  view.svg.line(view.x - 0.5 * view.scale * window, view.y, view.x + 0.5 * view.scale * window, view.y,
                "strip-line");
}

// A line below the drawing, some 100 px long.
void draw_scale(Svg &svg, const double scale, const double x, const double y)
{
  const double metres = scale > 450 ? 0.2 : scale > 180 ? 0.5 : scale > 90 ? 1 : scale > 45 ? 2 : 4;
  svg.line(x, y, x + scale * metres, y, "dimension");
  for (const double end : {0.0, metres})
    svg.line(x + scale * end, y - 4, x + scale * end, y + 4, "dimension");
  svg.text(x + scale * metres + 8, y + 4, fixed(1000 * metres, 0) + " [mm]", "axis");
}
}  // namespace

std::string stand_to_scale(const Run &run)
{
  const Sizes size(run);
  for (const char *name :
       {"work_roll_diameter", "work_roll_length", "work_neck_diameter", "work_total_length", "work_bearing_span",
        "backup_diameter", "backup_length", "backup_neck_diameter", "backup_neck_length", "backup_bearing_span"})
    if (!(size(name) > 0))
      return "";
  const Heights heights = heights_of(size);
  const double broad    = 2 * half_length(size);
  const double side     = size("housing_window_width") + 2 * size("housing_post_width");
  const double scale = std::min(view_height / (heights.top - heights.bottom), (430 - view_gap) / (broad + side));
  const double width = scale * (broad + side) + (side > 0 ? view_gap : 0) + 20;
  const double tall  = scale * (heights.top - heights.bottom);
  Svg svg(std::max(width, 300.0), tall + view_foot, "the stand to scale in mm");
  const double x = 10 + 0.5 * scale * broad, y = 6 + scale * heights.top;
  draw_along_rolling({svg, scale, x, y}, size, heights);
  if (side > 0)
    draw_along_rolls({svg, scale, 10 + scale * broad + view_gap + 0.5 * scale * side, y}, size, heights);
  draw_scale(svg, scale, 10, tall + 30);
  svg.text(std::max(width, 300.0) - 10, tall + 34,
           "\u2300 " + fixed(1e3 * size("work_roll_diameter"), 0) + " / " +
               fixed(1e3 * size("backup_diameter"), 0),
           "axis", Anchor::end);
  return svg.str();
}
}  // namespace mill::report
