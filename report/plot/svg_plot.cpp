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
void draw_axes(Svg &svg, const Plot &plot, const Layout &layout)
{
  for (const double value : layout.x_ticks.minor)
    svg.line(layout.to_x(value), layout.top, layout.to_x(value), layout.bottom, "grid minor");
  for (const double value : layout.y_ticks.minor)
    svg.line(layout.left, layout.to_y(value), layout.right, layout.to_y(value), "grid minor");
  for (std::size_t i = 0; i < layout.x_ticks.at.size(); ++i) {
    const double x = layout.to_x(layout.x_ticks.at[i]);
    if (plot.x.categories.empty())
      svg.line(x, layout.top, x, layout.bottom, "grid");
    svg.text(x, layout.bottom + 16, layout.x_ticks.labels[i], "t tx", Anchor::middle);
  }
  for (std::size_t i = 0; i < layout.y_ticks.at.size(); ++i) {
    const double y = layout.to_y(layout.y_ticks.at[i]);
    svg.line(layout.left, y, layout.right, y, "grid");
    svg.text(layout.left - 6, y + 4, layout.y_ticks.labels[i], "t ty", Anchor::end);
  }
  svg.rect(layout.left, layout.top, layout.right - layout.left, layout.bottom - layout.top, "frame");
  svg.text((layout.left + layout.right) / 2, layout.bottom + 34, plot.x.quantity + " [" + plot.x.unit + "]",
           "axis", Anchor::middle);
  svg.upright_text(14, (layout.top + layout.bottom) / 2, plot.y.quantity + " [" + plot.y.unit + "]", "axis");
}

void draw_legend(Svg &svg, const Plot &plot, const Layout &layout)
{
  if (!plot.title.empty())
    svg.text(34, 15, plot.title, "title");
  for (const Entry &entry : layout.legend) {
    const double x = 34 + entry.x, y = layout.legend_top + (entry.row + 0.5) * plot_legend_row;
    if (entry.bar)
      svg.rect(x, y - 5, 24, 10, "bar " + entry.classes);
    if (entry.joined)
      svg.line(x, y, x + 24, y, "pen " + entry.classes);
    if (entry.markers)
      svg.circle(x + 12, y, 2.6, "dot " + entry.classes);
    svg.text(x + 30, y + 4, entry.label, "t");
  }
}

void draw_flags(Svg &svg, const Layout &layout)
{
  const auto base = [&](const Flag &flag) { return layout.top - 6 - flag.row * plot_mark_row; };
  for (const Flag &flag : layout.flags)
    svg.line(flag.x, base(flag) + 3, flag.x, layout.bottom, "mark");
  for (const Flag &flag : layout.flags) {  // above all lines: that of another mark may pass behind a name
    svg.text((flag.left + flag.right) / 2, base(flag), flag.mark->label, "flag", Anchor::middle);
    if (flag.mark->support)
      svg.polyline({{flag.x, layout.bottom - 11}, {flag.x - 7, layout.bottom}, {flag.x + 7, layout.bottom}},
                   "support", true);
  }
}

void draw_stroke(Svg &svg, const Line &line, const Plot &plot, const Layout &layout)
{
  Eigen::VectorXd x(line.x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i)
    x[i] = drawable(line.x[i], plot.x) ? layout.to_x(line.x[i]) : layout.left - 1;
  std::vector<Eigen::Vector2d> stroke;
  const auto finish = [&] {
    if (stroke.size() > 1)
      svg.polyline(stroke, std::string("pen ") + class_of(line.pen));
    stroke.clear();
  };
  for (const Eigen::Index i : envelope(x, line.y, 1.0)) {
    if (drawable(line.x[i], plot.x) && drawable(line.y[i], plot.y))
      stroke.emplace_back(x[i], layout.to_y(line.y[i]));
    else
      finish();
  }
  finish();
}

void draw_lines(Svg &svg, const Plot &plot, const Layout &layout)
{
  for (const Line &line : plot.lines) {
    if (line.joined)
      draw_stroke(svg, line, plot, layout);
    if (line.markers)
      for (Eigen::Index i = 0; i < line.x.size(); ++i)
        if (drawable(line.x[i], plot.x) && drawable(line.y[i], plot.y))
          svg.circle(layout.to_x(line.x[i]), layout.to_y(line.y[i]), 2.6,
                     std::string("dot ") + class_of(line.pen));
  }
}

void draw_bars(Svg &svg, const Plot &plot, const Layout &layout)
{
  const double width = 0.72 / double(std::max<std::size_t>(1, plot.bars.size()));
  for (std::size_t set = 0; set < plot.bars.size(); ++set) {
    const Bars &bars = plot.bars[set];
    for (Eigen::Index i = 0; i < bars.height.size(); ++i) {
      if (!std::isfinite(bars.height[i]))
        continue;
      const double left = layout.to_x(double(i) - 0.36 + width * double(set));
      const double y    = layout.to_y(bars.height[i]);
      svg.rect(left, std::min(y, layout.to_y(0)), layout.to_x(layout.to_x.range.low + width) - layout.left,
               std::abs(layout.to_y(0) - y), std::string("bar ") + class_of(bars.pen));
    }
  }
}

// The name stands below the point on the right, where a rising curve leaves room, or above it on the left.
void draw_points(Svg &svg, const Plot &plot, const Layout &layout)
{
  for (const Point &point : plot.points) {
    if (!drawable(point.x, plot.x) || !drawable(point.y, plot.y))
      continue;
    const double x = layout.to_x(point.x), y = layout.to_y(point.y);
    svg.circle(x, y, 5, "point");
    const bool low = y + 18 > layout.bottom;
    if (x + 10 + text_width(point.label, plot_font) < layout.right)
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

void note_values(Svg &svg, const Plot &plot, const Layout &layout)
{
  if (plot.lines.empty() || !plot.x.categories.empty() || data_range(plot, false).empty())
    return;
  svg.note("x", axis_note(plot.x, layout.to_x));
  svg.note("y", axis_note(plot.y, layout.to_y));
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
  const Layout layout = layout_of(plot);
  Svg svg(plot.width, plot.height, description_of(plot));
  note_values(svg, plot, layout);
  draw_axes(svg, plot, layout);
  svg.begin_clip(layout.left, layout.top, layout.right - layout.left, layout.bottom - layout.top);
  draw_bars(svg, plot, layout);
  draw_lines(svg, plot, layout);
  svg.end_clip();
  draw_flags(svg, layout);
  draw_points(svg, plot, layout);
  draw_legend(svg, plot, layout);
  if (data_range(plot, false).empty())
    svg.text((layout.left + layout.right) / 2, (layout.top + layout.bottom) / 2,
             "no finite value in the stored data", "t", Anchor::middle);
  return svg.str();
}
}  // namespace mill::report
