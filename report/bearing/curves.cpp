#include "report/page/curves.h"
#include "core/records/rows_of_bearing.h"
#include "report/bearing/figures.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
const Pen row_pens[] = {Pen::dark, Pen::warm, Pen::dashed, Pen::dotted};

// Load over secant is the displacement; of the other models only the secant is stored.
void add_by_secant(Plot &plot, const Table &curve, const std::string &column, const std::string &label,
                   const Pen pen)
{
  const Eigen::VectorXd load = values_of(curve, {"load", "kN"}), secant = values_of(curve, {column, "kN/mm"});
  if (load.size() > 0 && secant.size() == load.size())
    plot.lines.push_back({label, 1e3 * load.cwiseQuotient(secant), load, pen});
}
}  // namespace

std::vector<std::string> results_of_bearing(const Run &run, const std::string &bearing)
{
  std::vector<std::string> names;
  for (const char *name : {"Kzc", "Kzc1", "Kzc2", "Kzc3", "Kzc4"}) {
    const Result *tangent = run.find(row::bearing::tangent.of(name));
    const Result *result  = tangent ? tangent : run.find(name);
    if (result && std::any_of(result->inputs.begin(), result->inputs.end(), [&](const std::string &input) {
          return input.rfind("bearing." + bearing + ".", 0) == 0;
        }))
      names.push_back(name);
  }
  return names;
}

std::vector<Mark> bearing_loads(const Run &run, const std::string &bearing)
{
  std::vector<Mark> marks;
  for (const std::string &name : results_of_bearing(run, bearing)) {
    const Result *tangent = run.find(row::bearing::tangent.of(name));
    const double load     = quantity_at(tangent ? *tangent : *run.find(name), "kN");
    if (!marks.empty() && std::abs(marks.back().x - load) <= 1e-9 * load)
      marks.back().label += ", " + name;
    else
      marks.push_back({load, name});
  }
  return marks;
}

std::string force_over_displacement(const Table &curve)
{
  Plot plot;
  plot.title  = "Load over displacement";
  plot.width  = 330;
  plot.height = 360;
  plot.x      = {"displacement of the inner ring", "\u00b5m"};
  plot.y      = {"radial load of one bearing", "kN"};
  plot.x.low = plot.y.low = 0;
  add_line(plot, curve, {"displacement", "\u00b5m"}, {"load", "kN"}, "this run", Pen::dark, true);
  add_by_secant(plot, curve, "rigid_secant", "the same, rigid rings", Pen::warm);
  add_by_secant(plot, curve, "standard_secant", "standard, rigid rings", Pen::pale);
  return svg_plot(plot);
}

std::string stiffness_over_load(const Table &curve, const std::vector<Mark> &loads)
{
  Plot plot;
  const bool with_standard = values_of(curve, {"standard_tangent", "kN/mm"}).size() > 0;
  plot.title               = "Radial stiffness over load";
  plot.width               = with_standard ? 660 : 360;
  plot.height              = with_standard ? 360 : 330;
  plot.x                   = {"radial load of one bearing", "kN", Scale::logarithmic};
  plot.y                   = {"stiffness Kzc", "kN/mm"};
  const auto add = [&](const char *column, const char *label, const Pen pen, const bool markers = false) {
    add_line(plot, curve, {"load", "kN"}, {column, "kN/mm"}, label, pen, markers);
  };
  add("tangent", with_standard ? "tangent, this run" : "tangent", Pen::dark, true);
  add("secant", with_standard ? "secant, this run" : "secant", with_standard ? Pen::dark_dashed : Pen::dashed);
  add("rigid_tangent", "tangent, the same with rigid rings", Pen::warm);
  add("rigid_secant", "secant, the same with rigid rings", Pen::warm_dashed);
  add("standard_tangent", "tangent, standard, rigid rings", Pen::pale);
  add("standard_secant", "secant, standard, rigid rings", Pen::pale_dashed);
  plot.marks = loads;
  return svg_plot(plot);
}

std::string shares_over_load(const Table &curve, const std::vector<Mark> &loads)
{
  Plot plot;
  plot.title = "Shares over load";
  plot.width = 330;
  plot.x     = {"radial load of one bearing", "kN", Scale::logarithmic};
  plot.y     = {"share of the radial load", "%"};
  for (int row = 1; row <= 4; ++row) {
    const std::string name = "row" + std::to_string(row);
    add_line(plot, curve, {"load", "kN"}, {name + "_share", "%"}, "row " + std::to_string(row), row_pens[row - 1]);
  }
  if (plot.lines.empty())
    return "";
  plot.marks = loads;
  return svg_plot(plot);
}

std::string share_bars(const Table &rows)
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

std::string cage_variation(const Table &cage)
{
  Plot plot;
  plot.title     = "Stiffness while the cage turns";
  plot.width     = 400;
  plot.height    = 280;
  plot.x         = {"angle of the cage", "\u00b0"};
  plot.y         = {"deviation from the mean", "%"};
  const auto add = [&](const char *column, const Pen pen) {
    const Eigen::VectorXd angle = values_of(cage, {"angle", "\u00b0"}), k = values_of(cage, {column, "kN/mm"});
    if (k.size() > 0 && angle.size() == k.size())
      plot.lines.push_back({column, angle, 100 * (k.array() / k.mean() - 1), pen, true});
  };
  add("tangent", Pen::dark);
  add("secant", Pen::warm);
  return svg_plot(plot);
}

std::string cage_sentence(const Table &cage)
{
  std::string text;
  for (const char *column : {"tangent", "secant"})
    if (const Eigen::VectorXd k = values_of(cage, {column, "kN/mm"}); k.size() > 0)
      text += (text.empty() ? "" : "; ") + std::string(column) + " " + significant(k.mean(), 4) +
              "\u00a0kN/mm in the mean, " +
              significant(100 * (k.maxCoeff() - k.minCoeff()) / std::abs(k.mean()), 2) +
              "\u00a0% from the softest to the stiffest place";
  return text;
}

std::string row_table(const Table &rows)
{
  struct Entry {
    const char *column, *unit, *head;
    int decimals;
  };
  const Entry entries[] = {
      {"share", "%", "share [%]", 1},
      {"axial", "kN", "axial force [kN]", 2},
      {"roller_max", "kN", "heaviest roller [kN]", 2},
      {"rib_max", "kN", "largest rib force [kN]", 3},
      {"roller_secant", "kN/mm", "its secant [kN/mm]", 1},
      {"roller_tangent", "kN/mm", "its tangent [kN/mm]", 1},
  };
  std::string head = "<th>row</th>", body;
  std::vector<std::pair<Eigen::VectorXd, int>> columns;
  for (const Entry &entry : entries)
    if (const Eigen::VectorXd values = values_of(rows, {entry.column, entry.unit}); values.size() > 0) {
      head += std::string("<th>") + entry.head + "</th>";
      columns.emplace_back(values, entry.decimals);
    }
  if (columns.size() < 2)
    return "";
  for (Eigen::Index row = 0; row < columns[0].first.size(); ++row) {
    body += "<tr><th scope=\"row\">" + std::to_string(row + 1) + "</th>";
    for (const auto &[values, decimals] : columns)
      body += "<td class=\"num\">" + fixed(values[row], decimals) + "</td>";
    body += "</tr>\n";
  }
  return "<table><thead><tr>" + head + "</tr></thead>\n<tbody>\n" + body + "</tbody></table>\n";
}
}  // namespace mill::report
