#pragma once
#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

namespace mill::report {
constexpr double page_width = 1040;  // px, of a plot as wide as the page

enum class Scale { linear, logarithmic };

/// One axis: what it shows, in which unit, how far.
struct Axis {
  std::string quantity;  ///< "approach"
  std::string unit;      ///< "µm"; "-" for a pure number; never empty
  Scale scale = Scale::linear;
  double low  = std::numeric_limits<double>::quiet_NaN();  ///< in `unit`; NaN: from the data
  double high = std::numeric_limits<double>::quiet_NaN();  ///< in `unit`; NaN: from the data
  std::vector<std::string> categories = {};  ///< names of the positions 0, 1, 2, ... instead of numbers
};

/// How a line is drawn.  Pens differ in lightness and dash, so that they stay apart on a grey print; shades, from
/// light to dark, are for dots that belong to growing values of a third quantity.
enum class Pen {
  dark,
  warm,
  dashed,
  dotted,
  pale,
  chained,
  warm_dashed,
  dark_dashed,
  pale_dashed,
  shade1,
  shade2,
  shade3,
  shade4,
  shade5
};

/// One curve; x increasing where it has many points (they are drawn as an envelope).
struct Line {
  std::string label;  ///< in the legend; empty: not listed
  Eigen::VectorXd x;  ///< (n) in the unit of the x axis
  Eigen::VectorXd y;  ///< (n) in the unit of the y axis; NaN, and values <= 0 on a logarithmic axis, are gaps
  Pen pen      = Pen::dark;
  bool markers = false;  ///< a dot at every sample
  bool joined  = true;   ///< a stroke between the samples
};

/// One point with a name, a working load for instance.
struct Point {
  double x, y;
  std::string label;
};

/// A vertical line with a name above the plot: a natural frequency, a barrel end.
struct Mark {
  double x;
  std::string label;
  bool support = false;  ///< a bearing: a triangle below the line
};

/// Bars side by side at x = 0, 1, 2, ...
struct Bars {
  std::string label;
  Eigen::VectorXd height;  ///< (n) in the unit of the y axis
  Pen pen = Pen::dark;
};

/// A diagram as a plain struct; its caller decides on the units.
struct Plot {
  std::string title;  ///< above the plot; empty: none
  Axis x, y;
  std::vector<Line> lines;
  std::vector<Bars> bars;
  std::vector<Point> points;
  std::vector<Mark> marks;
  double width  = 500;  ///< px
  double height = 330;  ///< px
};

/// Name of the class that page.css gives this pen.
const char *class_of(Pen pen);

/// The diagram as one <svg> element.  Legend and mark names stand above the plot area and never on the curves; a
/// record of any length costs at most four points per pixel column and keeps its peaks (envelope.h).
/// A diagram without a single finite point says so in the plot area.
std::string svg_plot(const Plot &plot);
}  // namespace mill::report
