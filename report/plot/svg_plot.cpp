#include "report/plot/svg_plot.h"
#include "report/plot/envelope.h"
#include "report/plot/number.h"
#include "report/plot/plot_layout.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::report {
namespace {
void draw_axes(Svg &svg, const Plot &plot, const Layout &at)
{
  for (const double value : at.x_ticks.minor)
    svg.line(at.to_x(value), at.top, at.to_x(value), at.bottom, "grid minor");
  for (const double value : at.y_ticks.minor)
    svg.line(at.left, at.to_y(value), at.right, at.to_y(value), "grid minor");
  for (std::size_t i = 0; i < at.x_ticks.at.size(); ++i) {
    const double x = at.to_x(at.x_ticks.at[i]);
    if (plot.x.categories.empty())
      svg.line(x, at.top, x, at.bottom, "grid");
    svg.text(x, at.bottom + 16, at.x_ticks.labels[i], "t tx", Anchor::middle);
  }
  for (std::size_t i = 0; i < at.y_ticks.at.size(); ++i) {
    const double y = at.to_y(at.y_ticks.at[i]);
    svg.line(at.left, y, at.right, y, "grid");
    svg.text(at.left - 6, y + 4, at.y_ticks.labels[i], "t ty", Anchor::end);
  }
  svg.rect(at.left, at.top, at.right - at.left, at.bottom - at.top, "frame");
  svg.text((at.left + at.right) / 2, at.bottom + 34, plot.x.quantity + " [" + plot.x.unit + "]", "axis",
           Anchor::middle);
  svg.upright_text(14, (at.top + at.bottom) / 2, plot.y.quantity + " [" + plot.y.unit + "]", "axis");
}

void draw_legend(Svg &svg, const Plot &plot, const Layout &at)
{
  if (!plot.title.empty())
    svg.text(34, 15, plot.title, "title");
  for (const Entry &entry : at.legend) {
    const double x = 34 + entry.x, y = at.legend_top + (entry.row + 0.5) * plot_legend_row;
    if (entry.bar)
      svg.rect(x, y - 5, 24, 10, "bar " + entry.classes);
    if (entry.joined)
      svg.line(x, y, x + 24, y, "pen " + entry.classes);
    if (entry.markers)
      svg.circle(x + 12, y, 2.6, "dot " + entry.classes);
    svg.text(x + 30, y + 4, entry.label, "t");
  }
}

void draw_flags(Svg &svg, const Layout &at)
{
  const auto base = [&](const Flag &flag) { return at.top - 6 - flag.row * plot_mark_row; };
  for (const Flag &flag : at.flags)
    svg.line(flag.x, base(flag) + 3, flag.x, at.bottom, "mark");
  for (const Flag &flag : at.flags) {  // above all lines: that of another mark may pass behind a name
    svg.text((flag.left + flag.right) / 2, base(flag), flag.mark->label, "flag", Anchor::middle);
    if (flag.mark->support)
      svg.polyline(
          {
              {flag.x,     at.bottom - 11},
              {flag.x - 7, at.bottom     },
              {flag.x + 7, at.bottom     }
      },
          "support", true);
  }
}

void draw_stroke(Svg &svg, const Line &line, const Plot &plot, const Layout &at)
{
  Eigen::VectorXd x(line.x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] = drawable(line.x[i], plot.x) ? at.to_x(line.x[i]) : at.left - 1;
  std::vector<Eigen::Vector2d> stroke;
  const auto finish = [&] {
    if (stroke.size() > 1)
      svg.polyline(stroke, std::string("pen ") + class_of(line.pen));
    stroke.clear();
  };
  for (const Eigen::Index i : envelope(x, line.y, 1.0)) {
    if (drawable(line.x[i], plot.x) && drawable(line.y[i], plot.y))
      stroke.emplace_back(x[i], at.to_y(line.y[i]));
    else
      finish();
  }
  finish();
}

void draw_lines(Svg &svg, const Plot &plot, const Layout &at)
{
  for (const Line &line : plot.lines) {
    if (line.joined)
      draw_stroke(svg, line, plot, at);
    if (line.markers)
      for (Eigen::Index i = 0; i < line.x.size(); ++i)
        if (drawable(line.x[i], plot.x) && drawable(line.y[i], plot.y))
          svg.circle(at.to_x(line.x[i]), at.to_y(line.y[i]), 2.6, std::string("dot ") + class_of(line.pen));
  }
}

void draw_bars(Svg &svg, const Plot &plot, const Layout &at)
{
  const double width = 0.72 / double(std::max<std::size_t>(1, plot.bars.size()));
  for (std::size_t set = 0; set < plot.bars.size(); ++set) {
    const Bars &bars = plot.bars[set];
    for (Eigen::Index i = 0; i < bars.height.size(); ++i) {
      if (!std::isfinite(bars.height[i]))
        continue;
      const double left = at.to_x(double(i) - 0.36 + width * double(set));
      const double y    = at.to_y(bars.height[i]);
      svg.rect(left, std::min(y, at.to_y(0)), at.to_x(at.to_x.range.low + width) - at.left,
               std::abs(at.to_y(0) - y), std::string("bar ") + class_of(bars.pen));
    }
  }
}

// The name stands below the point on the right, where a rising curve leaves room, or above it on the left.
void draw_points(Svg &svg, const Plot &plot, const Layout &at)
{
  for (const Point &point : plot.points) {
    if (!drawable(point.x, plot.x) || !drawable(point.y, plot.y))
      continue;
    const double x = at.to_x(point.x), y = at.to_y(point.y);
    svg.circle(x, y, 5, "point");
    const bool low = y + 18 > at.bottom;
    if (x + 10 + text_width(point.label, plot_font) < at.right)
      svg.text(x + 9, low ? y - 4 : y + 14, point.label, "flag halo");
    else
      svg.text(x - 9, y - 8, point.label, "flag halo", Anchor::end);
  }
}

// What page.js needs to read a value off a drawn line under the pointer: the plot area in px with the values at
// its ends, and the names of the lines by their pens.
std::string axis_note(const Axis &axis, const Mapping &to)
{
  return pixel(to.first) + " " + pixel(to.last) + " " + fmt::format("{:.9g} {:.9g}", to.range.low, to.range.high) +
         (axis.scale == Scale::logarithmic ? " log " : " linear ") + axis.unit;
}

void note_values(Svg &svg, const Plot &plot, const Layout &at)
{
  if (plot.lines.empty() || !plot.x.categories.empty() || data_range(plot, false).empty())
    return;
  svg.note("x", axis_note(plot.x, at.to_x));
  svg.note("y", axis_note(plot.y, at.to_y));
  std::string names;
  for (const Line &line : plot.lines)
    if (line.joined)
      names += (names.empty() ? "" : "|") + std::string(class_of(line.pen)) + "=" + line.label;
  svg.note("lines", names);
}

std::string description_of(const Plot &plot)
{
  return (plot.title.empty() ? "" : plot.title + ": ") + plot.y.quantity + " in " + plot.y.unit + " over " +
         plot.x.quantity + " in " + plot.x.unit;
}
}  // namespace

const char *class_of(const Pen pen)
{
  static const char *const classes[] = {"dark",    "warm",        "dashed",      "dotted",      "pale",
                                        "chained", "warm-dashed", "dark-dashed", "pale-dashed", "shade-1",
                                        "shade-2", "shade-3",     "shade-4",     "shade-5"};
  return classes[int(pen)];
}

std::string svg_plot(const Plot &plot)
{
  const Layout at = layout_of(plot);
  Svg svg(plot.width, plot.height, description_of(plot));
  note_values(svg, plot, at);
  draw_axes(svg, plot, at);
  svg.begin_clip(at.left, at.top, at.right - at.left, at.bottom - at.top);
  draw_bars(svg, plot, at);
  draw_lines(svg, plot, at);
  svg.end_clip();
  draw_flags(svg, at);
  draw_points(svg, plot, at);
  draw_legend(svg, plot, at);
  if (data_range(plot, false).empty())
    svg.text((at.left + at.right) / 2, (at.top + at.bottom) / 2, "no finite value in the stored data", "t",
             Anchor::middle);
  return svg.str();
}
}  // namespace mill::report
