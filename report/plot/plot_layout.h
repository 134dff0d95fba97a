#pragma once
#include "report/plot/svg_plot.h"
#include "report/plot/ticks.h"
#include <limits>
#include <string>
#include <vector>

// Where everything of a diagram goes; svg_plot.cpp draws it.
namespace mill::report {
constexpr double plot_font       = 12;  ///< px, as .t and .axis in page.css
constexpr double plot_legend_row = 17;  ///< px
constexpr double plot_mark_row   = 14;  ///< px

struct Range {
  double low  = std::numeric_limits<double>::infinity();   ///< in the unit of the axis
  double high = -std::numeric_limits<double>::infinity();  ///< in the unit of the axis
  void include(double value);
  bool empty() const;
};

/// A value this axis can show: finite, and positive on a logarithmic one.
bool drawable(double value, const Axis &axis);

/// Smallest and largest drawable value of all lines, bars and points; empty() without any.
Range data_range(const Plot &plot, bool of_x);

/// Value to pixel, linear or logarithmic.
struct Mapping {
  Scale scale;
  Range range;
  double first;  ///< px of range.low
  double last;   ///< px of range.high
  double operator()(double value) const;
};

/// One entry of the legend.
struct Entry {
  std::string label, classes;
  bool bar, markers, joined;
  double x = 0;  ///< px, from the left end of the legend
  int row  = 0;
};

/// The name of a mark above the plot.
struct Flag {
  const Mark *mark;
  double x;            ///< px, of the line
  double left, right;  ///< px, of the name
  int row = 0;
};

/// The plot area and everything that has to be known before it can be placed: the legend and the mark names decide
/// about its top, the tick labels about its left side.
struct Layout {
  double left, right, top, bottom;  ///< px
  Mapping to_x, to_y;
  Ticks x_ticks, y_ticks;
  std::vector<Entry> legend;
  double legend_top = 0;  ///< px
  std::vector<Flag> flags;
};
Layout layout_of(const Plot &plot);
}  // namespace mill::report
