#include "report/plot/plot_layout.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
void Range::include(const double value)
{
  low  = std::min(low, value);
  high = std::max(high, value);
}

bool Range::empty() const
{
  return !(low <= high);
}

double Mapping::operator()(const double value) const
{
  const double share = scale == Scale::linear ? (value - range.low) / (range.high - range.low)
                                              : std::log(value / range.low) / std::log(range.high / range.low);
  return first + share * (last - first);
}

bool drawable(const double value, const Axis &axis)
{
  return std::isfinite(value) && (axis.scale == Scale::linear || value > 0);
}

Range data_range(const Plot &plot, const bool of_x)
{
  const Axis &axis = of_x ? plot.x : plot.y;
  Range range;
  const auto include = [&](const double value) {
    if (drawable(value, axis))
      range.include(value);
  };
  for (const Line &line : plot.lines)
    for (const double value : of_x ? line.x : line.y)
      include(value);
  for (const Point &point : plot.points)
    include(of_x ? point.x : point.y);
  for (const Bars &bars : plot.bars) {
    if (of_x) {
      include(-0.5);
      include(double(bars.height.size()) - 0.5);
    } else {
      include(0);
      for (const double value : bars.height)
        include(value);
    }
  }
  return range;
}

namespace {
// Ends of an axis: those the caller fixed, else the data with a little room.
Range axis_range(const Plot &plot, const bool of_x)
{
  const Axis &axis = of_x ? plot.x : plot.y;
  Range range      = data_range(plot, of_x);
  if (!range.empty() && std::isfinite(axis.low))
    range.include(axis.low);
  if (!range.empty() && std::isfinite(axis.high))
    range.include(axis.high);
  if (range.empty())
    range = axis.scale == Scale::linear ? Range{0, 1} : Range{1, 10};
  if (axis.scale == Scale::logarithmic) {
    const double room = of_x ? 1 : 1.2;
    range             = {range.low / room, range.high * room};
    if (range.high < 1.5 * range.low)
      range = {range.low / 1.5, range.high * 1.5};
  } else if (range.high - range.low <= 1e-12 * std::max(std::abs(range.low), std::abs(range.high))) {
    const double room = range.high != 0 ? 0.05 * std::abs(range.high) : 1;  // a constant gets a visible band
    range             = {range.low - room, range.high + room};
  } else if (!of_x) {
    const double room = 0.06 * (range.high - range.low);
    range             = {plot.bars.empty() ? range.low - room : range.low, range.high + room};
  }
  if (std::isfinite(axis.low))
    range.low = axis.low;
  if (std::isfinite(axis.high))
    range.high = axis.high;
  if (!(range.low < range.high))
    range.high = range.low + std::max(1.0, std::abs(range.low));
  return range;
}

Ticks ticks_of(const Axis &axis, const Range &range, const double length, const double spacing)
{
  if (axis.categories.empty()) {
    const int wanted = std::max(2, int(length / spacing));
    return axis.scale == Scale::linear ? linear_ticks(range.low, range.high, wanted)
                                       : log_ticks(range.low, range.high, wanted);
  }
  Ticks ticks;
  for (std::size_t i = 0; i < axis.categories.size(); ++i)
    ticks.at.push_back(double(i));
  ticks.labels = axis.categories;
  return ticks;
}

std::vector<Entry> legend_of(const Plot &plot)
{
  std::vector<Entry> entries;
  for (const Line &line : plot.lines)
    if (!line.label.empty())
      entries.push_back({line.label, class_of(line.pen), false, line.markers, line.joined});
  for (const Bars &bars : plot.bars)
    if (!bars.label.empty())
      entries.push_back({bars.label, class_of(bars.pen), true, false, false});
  return entries;
}

// Sets the entries in rows no wider than the plot.  Returns the number of rows.
int arrange(std::vector<Entry> &entries, const double width)
{
  double x = 0;
  int row  = 0;
  for (Entry &entry : entries) {
    // Browsers without Helvetica or Arial set wider letters.
    const double needed = 32 + 1.15 * text_width(entry.label, plot_font) + 16;
    if (x > 0 && x + needed > width) {
      x = 0;
      ++row;
    }
    entry.x   = x;
    entry.row = row;
    x += needed;
  }
  return entries.empty() ? 0 : row + 1;
}

// Names above the plot: each goes to the first row in which it touches no other.
std::vector<Flag> arrange(const std::vector<Mark> &marks, const Mapping &to_x, const double width)
{
  std::vector<Flag> flags;
  for (const Mark &mark : marks) {
    if (!(mark.x >= to_x.range.low && mark.x <= to_x.range.high))
      continue;
    const double x = to_x(mark.x), half = text_width(mark.label, plot_font - 1) / 2 + 3;
    const double left = std::max(0.0, std::min(x - half, width - 2 * half));
    flags.push_back({&mark, x, left, left + 2 * half});
  }
  std::stable_sort(flags.begin(), flags.end(), [](const Flag &a, const Flag &b) { return a.x < b.x; });
  std::vector<double> free_from;
  for (Flag &flag : flags) {
    std::size_t row = 0;
    while (row < free_from.size() && free_from[row] > flag.left)
      ++row;
    if (row == free_from.size())
      free_from.push_back(0);
    free_from[row] = flag.right;
    flag.row       = int(row);
  }
  return flags;
}
}  // namespace

Layout layout_of(const Plot &plot)
{
  Layout layout;
  const Range x = axis_range(plot, true), y = axis_range(plot, false);
  layout.legend      = legend_of(plot);
  layout.right       = plot.width - 14;
  layout.bottom      = plot.height - 40;
  layout.legend_top  = plot.title.empty() ? 4 : 22;
  const int rows     = arrange(layout.legend, plot.width - 60);
  const double below = layout.legend_top + rows * plot_legend_row + 6;
  layout.y_ticks     = ticks_of(plot.y, y, layout.bottom - below, 42);
  double widest      = 0;
  for (const std::string &label : layout.y_ticks.labels)
    widest = std::max(widest, text_width(label, plot_font));
  layout.left    = 34 + widest;
  layout.x_ticks = ticks_of(plot.x, x, layout.right - layout.left, 75);
  if (!layout.x_ticks.labels.empty())  // the last label may stand at the very end of the axis
    layout.right =
        std::min(layout.right, plot.width - 2 - text_width(layout.x_ticks.labels.back(), plot_font) / 2);
  layout.to_x   = {plot.x.scale, x, layout.left, layout.right};
  layout.flags  = arrange(plot.marks, layout.to_x, plot.width);
  int flag_rows = 0;
  for (const Flag &flag : layout.flags)
    flag_rows = std::max(flag_rows, flag.row + 1);
  layout.top  = below + flag_rows * plot_mark_row + (flag_rows ? 4 : 0);
  layout.to_y = {plot.y.scale, y, layout.bottom, layout.top};
  return layout;
}
}  // namespace mill::report
