#include "report/page/curves.h"
#include "report/bite/figures.h"
#include "report/plot/heat_map.h"
#include <cctype>
#include <cmath>

namespace mill::report {
namespace {
using Eigen::VectorXd;

struct Input {
  const char *file, *quantity, *unit;
};
const Input inputs[] = {
    {"reduction", "reduction", "%"},
    {"tension", "tension, front and back", "MPa"},
    {"friction", "friction \u00b5", "-"},
    {"speed", "roll speed", "m/s"},
};

// Single points of the finite elements on the curve of the slab theory.
void add_points(Plot &plot, const Table &table, const Column &x, const Column &y, const std::string &label)
{
  const VectorXd positions = values_of(table, x), all = values_of(table, y);
  if (positions.size() == 0 || all.size() != positions.size())
    return;
  Line points{label, positions, all, Pen::warm, true};
  points.joined = false;
  plot.lines.push_back(points);
}

Plot over_input(const Input &input, const Axis &y)
{
  Plot plot;
  plot.title    = y.quantity + " over " + std::string(input.file);
  plot.title[0] = char(std::toupper(static_cast<unsigned char>(plot.title[0])));
  plot.width    = 333;
  plot.height   = 290;
  plot.x        = {input.quantity, input.unit};
  plot.y        = y;
  return plot;
}

// Mean thickness and projected length of the arc of a pass.
double aspect_of(const Table &arc)
{
  const VectorXd x = values_of(arc, {"x", "m"}), h = values_of(arc, {"thickness", "m"});
  if (x.size() < 2 || h.size() != x.size())
    return std::nan("");
  return x.maxCoeff() / (0.5 * (h.minCoeff() + h.maxCoeff()));
}
}  // namespace

std::vector<std::string> k4_curves(const Run &run)
{
  std::vector<std::string> drawings;
  for (const Input &input : inputs)
    if (const Table *table = stored_curve(run, curve::bite_k4, "", input.file)) {
      Plot plot = over_input(input, {"K4", "kN/mm"});
      const Column x{input.file, input.unit};
      add_line(plot, *table, x, {"plastic_slope", "kN/mm"}, "plastic slope", Pen::dark);
      add_line(plot, *table, x, {"combined", "kN/mm"}, "combined", Pen::dashed);
      add_points(plot, *table, x, {"fe_plastic_slope", "kN/mm"}, "plastic slope, finite elements");
      drawings.push_back(svg_plot(plot));
    }
  return drawings;
}

std::vector<std::string> bite_force_curves(const Run &run)
{
  std::vector<std::string> drawings;
  for (const Input &input : inputs)
    if (const Table *table = stored_curve(run, curve::bite_k4, "", input.file)) {
      Plot plot = over_input(input, {"force", "kN"});
      const Column x{input.file, input.unit};
      if (!add_line(plot, *table, x, {"force", "kN"}, "slab theory", Pen::dark))
        continue;
      add_points(plot, *table, x, {"fe_force", "kN"}, "finite elements");
      drawings.push_back(svg_plot(plot));
    }
  return drawings;
}

std::string k4_map(const Run &run)
{
  const Table *table = stored_curve(run, curve::bite_map);
  if (!table)
    return "";
  const VectorXd x = values_of(*table, {"reduction", "%"}), y = values_of(*table, {"friction", "-"}),
                 k = values_of(*table, {"plastic_slope", "kN/mm"});
  Eigen::Index m   = 0;  // points of one reduction
  while (m < x.size() && x[m] == x[0])
    ++m;
  if (m < 2 || x.size() % m != 0 || y.size() != x.size() || k.size() != x.size())
    return "";
  const Eigen::Index n = x.size() / m;
  HeatMap map;
  map.title    = "K4 by the slab theory, plastic slope; blank where the rolls cannot take the strip";
  map.x        = {"reduction", "%"};
  map.y        = {"friction \u00b5", "-"};
  map.quantity = "K4";
  map.unit     = "kN/mm";
  map.at_x     = VectorXd(n);
  map.at_y     = y.head(m);
  map.value    = Eigen::MatrixXd::Zero(n, m);
  for (Eigen::Index i = 0; i < n; ++i) {
    map.at_x[i] = x[i * m];
    for (Eigen::Index j = 0; j < m; ++j)
      map.value(i, j) = std::isfinite(k[i * m + j]) ? k[i * m + j] : 0;
  }
  return heat_map(map);
}

std::string bite_aspect(const Run &run, const std::vector<BitePass> &passes)
{
  const Table *table = stored_curve(run, curve::bite_aspect);
  if (!table)
    return "";
  Plot plot;
  plot.title = "Force of the finite elements over that of the slab theories";
  plot.width = 700;
  plot.x     = {"arc length over mean thickness", "-", Scale::logarithmic};
  plot.y     = {"ratio of the forces", "-"};
  add_line(plot, *table, {"arc_over_thickness", "-"}, {"ratio_karman", "-"}, "over K\u00e1rm\u00e1n, homogeneous",
           Pen::dark, true);
  add_line(plot, *table, {"arc_over_thickness", "-"}, {"ratio_orowan", "-"}, "over Orowan, inhomogeneous",
           Pen::dashed, true);
  const VectorXd positions = values_of(*table, {"arc_over_thickness", "-"});
  if (plot.lines.empty() || positions.size() < 2)
    return "";
  plot.lines.push_back(
      {"equal", Eigen::Vector2d(positions.minCoeff(), positions.maxCoeff()), Eigen::Vector2d(1, 1), Pen::pale});
  for (const BitePass &pass : passes)
    for (const std::string &model : {std::string("karman"), std::string("fe")})
      if (const Table *arc = bite_table(run, pass, model))
        if (const double a = aspect_of(*arc); a > positions.minCoeff() && a < positions.maxCoeff()) {
          plot.marks.push_back({a, pass.name});
          break;
        }
  return svg_plot(plot);
}
}  // namespace mill::report
