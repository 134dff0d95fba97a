#include "report/curves.h"
#include "report/names.h"
#include "report/number.h"
#include "report/sections.h"
#include "report/svg.h"
#include "report/ticks.h"
#include <cmath>

namespace mill::report {
namespace {
// Loads of the bearings Kzc1..4 that this curve belongs to, told by the keys they were made from.
std::vector<Mark> working_loads(const Run &run, const std::string &bearing)
{
  std::vector<Mark> marks;
  for (int i = 1; i <= 4; ++i) {
    const std::string name = "Kzc" + std::to_string(i);
    const Result *result   = run.find(name + ".tangent") ? run.find(name + ".tangent") : run.find(name);
    if (!result)
      continue;
    for (const std::string &input : result->inputs)
      if (input.rfind("bearing." + bearing, 0) == 0) {
        const double load = quantity_in_text(result->at, "kN");
        if (!marks.empty() && std::abs(marks.back().x - load) <= 1e-9 * load)
          marks.back().label += ", " + name;
        else
          marks.push_back({load, name});
        break;
      }
  }
  return marks;
}

std::string stiffness_over_load(const Run &run, const std::string &name, const Table &curve)
{
  Plot plot;
  plot.title = "Radial stiffness over load";
  plot.width = 360;
  plot.x     = {"radial load of one bearing", "kN", Scale::logarithmic};
  plot.y     = {"stiffness Kzc", "kN/mm"};
  add_line(plot, curve, {"load", "kN"}, {"tangent", "kN/mm"}, "tangent", Pen::dark, true);
  add_line(plot, curve, {"load", "kN"}, {"secant", "kN/mm"}, "secant", Pen::dashed);
  plot.marks = working_loads(run, name);
  return svg_plot(plot);
}

std::string row_shares(const Table &rows)
{
  Plot plot;
  plot.title                  = "Share of the rows";
  plot.width                  = 270;
  plot.x                      = {"row", "-"};
  plot.y                      = {"share of the radial load", "%"};
  const Eigen::VectorXd share = values_of(rows, {"share", "%"});
  for (Eigen::Index i = 0; i < share.size(); ++i)
    plot.x.categories.push_back(std::to_string(i + 1));
  plot.bars.push_back({"", share, Pen::dark});
  return svg_plot(plot);
}

struct Polar {
  double x, y, radius;  // px, centre and radius of the largest load
  double largest;       // kN
  Eigen::Vector2d at(const double load, const double angle) const
  {
    // Angle zero is the direction of the load; it is drawn downwards, as the load of a bearing is thought of.
    const double r = radius * load / largest;
    return {x + r * std::sin(angle), y + r * std::cos(angle)};
  }
};

void draw_polar_grid(Svg &svg, const Polar &polar)
{
  for (int degree = 0; degree < 360; degree += 30) {
    const double angle = degree * EIGEN_PI / 180;
    const auto end     = polar.at(polar.largest, angle);
    svg.line(polar.x, polar.y, end[0], end[1], "grid");
    const auto label = polar.at(1.12 * polar.largest, angle);
    if (degree % 90 == 0)
      svg.text(label[0], label[1] + 4, std::to_string(degree) + "\u00b0", "t", Anchor::middle);
  }
  const Ticks ticks = linear_ticks(0, polar.largest, 3);
  for (std::size_t i = 0; i < ticks.at.size(); ++i) {
    if (ticks.at[i] == 0)
      continue;
    const double r = polar.radius * ticks.at[i] / polar.largest;
    svg.circle(polar.x, polar.y, r, "ring");
    svg.text(polar.x + r * 0.5 + 3, polar.y - r * 0.866, ticks.labels[i], "t halo");
  }
}

std::vector<Line> roller_rows(const Table &rollers)
{
  const Pen pens[]            = {Pen::dark, Pen::warm, Pen::dashed, Pen::dotted};
  const Eigen::VectorXd angle = values_of(rollers, {"angle", "rad"});
  std::vector<Line> rows;
  for (int row = 1; row <= 4; ++row) {
    const Eigen::VectorXd load = values_of(rollers, {"row" + std::to_string(row), "kN"});
    if (load.size() == 0 || load.size() != angle.size())
      continue;
    // Rows that carry the same are drawn once: four curves on top of each other show nothing.
    if (!rows.empty() && (rows[0].y - load).cwiseAbs().maxCoeff() <= 1e-6 * load.cwiseAbs().maxCoeff())
      rows[0].label = "each row";
    else
      rows.push_back({"row " + std::to_string(row), angle, load, pens[row - 1]});
  }
  return rows;
}

std::string roller_loads(const Table &rollers)
{
  Svg svg(360, 330, "load of every roller over its angle, roller load in kN");
  svg.text(20, 15, "Roller loads", "title");
  const auto rows = roller_rows(rollers);
  double largest  = 0;
  for (const Line &row : rows)
    largest = std::max(largest, row.y.maxCoeff());
  const Polar polar{180, 172, 108, largest > 0 ? largest : 1};
  draw_polar_grid(svg, polar);
  double x = 20;
  for (const Line &row : rows) {
    std::vector<Eigen::Vector2d> points;
    for (Eigen::Index i = 0; i < row.x.size(); ++i)
      points.push_back(polar.at(row.y[i], row.x[i]));
    const std::string pen = class_of(row.pen);
    svg.polyline(points, "pen " + pen, true);
    for (const auto &point : points)
      svg.circle(point[0], point[1], 2, "dot " + pen);
    svg.line(x, 28, x + 24, 28, "pen " + pen);
    svg.text(x + 30, 32, row.label, "t");
    x += 78;
  }
  svg.text(180, 324, "roller load [kN] over angle from the load [\u00b0]", "axis", Anchor::middle);
  return svg.str();
}

void one_bearing(Page &page, const Run &run, const std::string &name)
{
  const std::string path = "curves/bearing-" + name;
  std::vector<std::string> drawings{stiffness_over_load(run, name, *run.table(path))};
  const Table *rows = run.table(path + "-rows"), *rollers = run.table(path + "-rollers");
  if (rows)
    drawings.push_back(row_shares(*rows));
  if (rollers)
    drawings.push_back(roller_loads(*rollers));
  page.heading("Bearing " + name);
  page.figure(drawings,
              "Bearing <code>" + escaped(name) +
                  "</code>: stiffness of <b>one</b> bearing (a roll has two) over its radial load, the shares "
                  "of its rows, and the load of every roller around the ring (0\u00b0: direction of the load). "
                  "Equal shares belong to a load without tilt; the loaded arc narrows with clearance.");
  if (!rows)
    page.absent("Row shares are", path + "-rows.csv");
  if (!rollers)
    page.absent("Roller loads are", path + "-rollers.csv");
}
}  // namespace

void bearing_section(Page &page, const Run &run)
{
  const auto bearings = names_of_curves(run, "bearing", {"rows", "rollers"});
  if (bearings.empty() && run.manifest.kind != "four-high")
    return;
  page.section("bearings", "Bearings");
  if (bearings.empty())
    page.absent("Bearing figures are", "curves/bearing-*.csv");
  for (const std::string &name : bearings)
    one_bearing(page, run, name);
}
}  // namespace mill::report
