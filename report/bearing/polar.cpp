#include "report/bearing/figures.h"
#include "report/page/curves.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/ticks.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
// Rows that carry the same, and what the standard says of the first of them.
struct RowGroup {
  std::string title;
  Eigen::VectorXd load, standard;  // kN; standard may be empty
};

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

void draw_grid(Svg &svg, const Polar &polar)
{
  for (int degree = 0; degree < 360; degree += 30) {
    const double angle = degree * EIGEN_PI / 180;
    const auto end     = polar.at(polar.largest, angle);
    svg.line(polar.x, polar.y, end[0], end[1], "grid");
    const auto label = polar.at(1.13 * polar.largest, angle);
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

bool same_loads(const Eigen::VectorXd &a, const Eigen::VectorXd &b)
{
  return a.size() == b.size() &&
         (a.size() == 0 || (a - b).cwiseAbs().maxCoeff() <= 1e-4 * a.cwiseAbs().maxCoeff());
}

std::vector<RowGroup> groups_of(const Table &rollers, const Eigen::Index n)
{
  std::vector<RowGroup> groups;
  std::vector<std::vector<int>> members;
  int rows = 0;
  for (int row = 1; row <= 4; ++row) {
    const std::string name         = "row" + std::to_string(row);
    const Eigen::VectorXd load     = values_of(rollers, {name, "kN"});
    const Eigen::VectorXd standard = values_of(rollers, {"standard_" + name, "kN"});
    if (load.size() == 0 || load.size() != n)
      continue;
    ++rows;
    std::size_t group = 0;
    while (group < groups.size() &&
           !(same_loads(groups[group].load, load) && same_loads(groups[group].standard, standard)))
      ++group;
    if (group == groups.size()) {
      groups.push_back({"", load, standard});
      members.emplace_back();
    }
    members[group].push_back(row);
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::string &title = groups[g].title;
    if (int(members[g].size()) == rows && rows > 1) {
      title = "Each row";
      continue;
    }
    title = members[g].size() > 1 ? "Rows" : "Row";
    for (std::size_t i = 0; i < members[g].size(); ++i)
      title += (i == 0 ? " " : i + 1 < members[g].size() ? ", " : " and ") + std::to_string(members[g][i]);
  }
  return groups;
}

void draw_row(Svg &svg, const Polar &polar, const Eigen::VectorXd &angle, const Eigen::VectorXd &load,
              const std::string &pen, const bool dots)
{
  std::vector<Eigen::Vector2d> points;
  for (Eigen::Index i = 0; i < angle.size(); ++i)
    points.push_back(polar.at(std::max(0.0, load[i]), angle[i]));
  svg.polyline(points, "pen " + pen, true);
  for (const auto &point : points)
    if (dots)
      svg.circle(point[0], point[1], 2, "dot " + pen);
}

void draw_legend(Svg &svg, const bool standard)
{
  svg.line(20, 29, 40, 29, "pen dark");
  svg.text(45, 33, "this run", "t");
  if (!standard)
    return;
  svg.line(102, 29, 122, 29, "pen pale");
  svg.text(127, 33, "standard, rigid rings", "t");
}
}  // namespace

std::vector<std::string> roller_polars(const Table &rollers)
{
  const Eigen::VectorXd angle = values_of(rollers, {"angle", "rad"});
  const auto groups           = groups_of(rollers, angle.size());
  double largest              = 0;
  for (const RowGroup &group : groups)
    largest = std::max({largest, group.load.maxCoeff(), group.standard.size() ? group.standard.maxCoeff() : 0.0});
  const double size = groups.size() == 1 ? 360 : groups.size() == 2 ? 330 : 245;
  std::vector<std::string> drawings;
  for (const RowGroup &group : groups) {
    Svg svg(size, size + 32, group.title + ": load of every roller over its angle, roller load in kN");
    svg.text(20, 15, groups.size() == 1 ? "Roller loads, " + group.title : group.title, "title");
    const Polar polar{size / 2, size / 2 + 22, size / 2 - 38, largest > 0 ? largest : 1};
    draw_grid(svg, polar);
    if (group.standard.size() == angle.size())
      draw_row(svg, polar, angle, group.standard, "pale", false);
    draw_row(svg, polar, angle, group.load, "dark", true);
    draw_legend(svg, group.standard.size() == angle.size());
    svg.text(size / 2, size + 27, "roller load [kN] over angle [\u00b0]", "axis", Anchor::middle);
    drawings.push_back(svg.str());
  }
  return drawings;
}

std::string heaviest_roller_sentence(const Table &rollers)
{
  const Eigen::VectorXd angle = values_of(rollers, {"angle", "rad"});
  double heaviest = 0, below = 0, off = 0;
  int row = 0;
  for (int r = 1; r <= 4; ++r) {
    const Eigen::VectorXd load = values_of(rollers, {"row" + std::to_string(r), "kN"});
    Eigen::Index index = 0, nearest = 0;
    if (load.size() == 0 || load.size() != angle.size() || load.maxCoeff(&index) <= heaviest)
      continue;
    const Eigen::VectorXd from =
        angle.unaryExpr([](const double a) { return std::abs(std::remainder(a, double(2 * EIGEN_PI))); });
    from.minCoeff(&nearest);
    heaviest = load[index];
    below    = load[nearest];
    off      = from[index];
    row      = r;
  }
  if (row == 0)
    return "";
  const std::string carries = "the heaviest roller, in row " + std::to_string(row) + ", carries " +
                              significant(heaviest, 4) + "\u00a0kN and lies ";
  // Two rollers astride of the load line are on it as well.
  if (off <= 0.51 * 2 * EIGEN_PI / double(angle.size()))
    return "<b>On the load line:</b> " + carries + "there, as between rigid rings.";
  return "<b>Off the load line:</b> " + carries + fixed(off * 180 / EIGEN_PI, 1) +
         "\u00b0 off it, while the roller on it carries " + significant(below, 4) +
         "\u00a0kN. The cup bends with its chock and passes the load to both sides: around the ring the load has "
         "the shape of an M.";
}
}  // namespace mill::report
