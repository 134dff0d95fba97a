#pragma once
#include "report/plot/svg_plot.h"
#include <Eigen/Core>
#include <string>

namespace mill::report {
/// A quantity over a grid of stations, as coloured cells with a scale next to them.
struct HeatMap {
  std::string title;
  Axis x, y;
  std::string quantity, unit;         ///< of the cells, "pressure", "MPa"
  Eigen::VectorXd at_x;               ///< (n) increasing, in the unit of the x axis
  Eigen::VectorXd at_y;               ///< (m) increasing, in the unit of the y axis
  Eigen::MatrixXd value;              ///< (n, m) in `unit`; zero and below stay blank
  double width = 1000, height = 300;  ///< px
};

/// Borders of the cells around n stations, (n + 1): half way between them, the outermost at the stations
/// themselves.
Eigen::VectorXd cell_borders(const Eigen::VectorXd &stations);

/// The map as one <svg> element: eight steps of one hue, so that it also reads on a grey print; neighbouring cells
/// of one step are drawn as one.
std::string heat_map(const HeatMap &map);
}  // namespace mill::report
