#include "report/study/optimum_section.h"
#include "core/records/search_goal.h"
#include "report/page/cells.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/study/study_values.h"
#include "report/twin/analysis/written_document.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
using nlohmann::json;

constexpr double near_optimum = 0.05;  // of the objective: inputs that are as good

const json &objective_of(const json &document)
{
  for (const json &result : document["results"])
    if (result["name"] == document["optimum"]["objective"])
      return result;
  return document["results"][0];
}

// The largest and smallest value of an input at which the objective is within 5 % of the optimum.
std::string flat_range(const json &optimum, const std::size_t key)
{
  const double best = number_in(optimum["value"]);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (const json &point : optimum["valley"][key])
    if (std::abs(number_in(point["value"]) - best) <= near_optimum * std::abs(best)) {
      low  = std::min(low, number_in(point["inputs"][key]));
      high = std::max(high, number_in(point["inputs"][key]));
    }
  const double optimal = number_in(optimum["inputs"][key]);
  return significant(std::min(low, optimal), 4) + " .. " + significant(std::max(high, optimal), 4);
}

std::string input_table(const json &document)
{
  const json &optimum = document["optimum"];
  std::string rows;
  for (std::size_t k = 0; k < document["keys"].size(); ++k) {
    const json &key = document["keys"][k];
    rows +=
        named_row(key["name"], cell(escaped(unit_sign(key["unit"]))) + "<td>" + escaped(key["written"]) + "</td>" +
                                   cell(significant(number_in(optimum["inputs"][k]), 5) +
                                        (optimum["at_bound"][k].get<bool>() ? " <small>(bound)</small>" : "")) +
                                   cell(flat_range(optimum, k)));
  }
  return table_of("<th>input</th><th>unit</th><th>bounds</th><th>at the optimum</th><th>objective within 5 %</th>",
                  rows);
}

std::string result_table(const json &document)
{
  const json &optimum = document["optimum"];
  std::string rows;
  for (std::size_t r = 0; r < optimum["results"].size(); ++r) {
    const json &result   = document["results"][r];
    const FloorUnit unit = floor_unit(result);
    rows += named_row(result["name"], cell(escaped(unit.sign)) +
                                          cell(significant(unit.factor * number_in(result["base"]), 5)) +
                                          cell(significant(unit.factor * number_in(optimum["results"][r]), 5)));
  }
  return table_of("<th>result</th><th>unit</th><th>base case</th><th>at the optimum</th>", rows);
}

std::string valley_along(const json &document, const std::size_t key)
{
  const json &optimum = document["optimum"], &result = objective_of(document), &points = optimum["valley"][key];
  const FloorUnit unit = floor_unit(result);
  const auto n         = Eigen::Index(points.size());
  Line line{"", Eigen::VectorXd(n), Eigen::VectorXd(n), Pen::dark, true};
  for (Eigen::Index i = 0; i < n; ++i) {
    line.x[i] = number_in(points[std::size_t(i)]["inputs"][key]);
    line.y[i] = unit.factor * number_in(points[std::size_t(i)]["value"]);
  }
  Plot plot;
  plot.width  = pair_width;
  plot.x      = axis_of_key(document["keys"][key]);
  plot.y      = axis_of_result(result);
  plot.lines  = {line};
  plot.points = {{number_in(optimum["inputs"][key]), unit.factor * number_in(optimum["value"]), "optimum"}};
  return svg_plot(plot);
}

// The other inputs along the valley of one.
std::string valley_table(const json &document, const std::size_t key)
{
  const json &optimum = document["optimum"], &result = objective_of(document);
  const FloorUnit unit = floor_unit(result);
  std::string head, rows;
  for (const json &one : document["keys"])
    head +=
        "<th>" + escaped(one["name"]) + (one["unit"].empty() ? "" : " [" + escaped(one["unit"]) + "]") + "</th>";
  head += "<th>" + escaped(result["name"]) + " [" + escaped(unit.sign) + "]</th>";
  for (const json &point : optimum["valley"][key]) {
    std::string cells;
    for (const json &input : point["inputs"])
      cells += cell(significant(number_in(input), 4));
    rows += "<tr>" + cells + cell(significant(unit.factor * number_in(point["value"]), 4)) + "</tr>";
  }
  return table_of(head, rows);
}

std::string progress(const json &document)
{
  const json &optimum = document["optimum"], &result = objective_of(document);
  const FloorUnit unit = floor_unit(result);
  const auto n         = Eigen::Index(optimum["path"].size());
  Line dots{"row", Eigen::VectorXd(n), Eigen::VectorXd(n), Pen::pale, true, false},
      best{"best so far", dots.x, dots.y};
  const bool greatest = choice_named<SearchGoal>(optimum["searched"].get<std::string>()) == SearchGoal::greatest;
  double so_far       = std::nan("");
  for (Eigen::Index i = 0; i < n; ++i) {
    const double value = unit.factor * number_in(optimum["path"][std::size_t(i)]);
    so_far             = std::isnan(so_far) || (greatest ? value > so_far : value < so_far) ? value : so_far;
    dots.x[i] = best.x[i] = double(i + 1);
    dots.y[i]             = value;
    best.y[i]             = so_far;
  }
  Plot plot;
  plot.width = page_width;
  plot.x     = {"row of the search", "-"};
  plot.y     = axis_of_result(result);
  plot.lines = {dots, best};
  return svg_plot(plot);
}
}  // namespace

void optimum_section(Page &page, const json &document)
{
  if (!document.contains("optimum"))
    return;
  page.section("optimum", "Optimum");
  const json &optimum = document["optimum"];
  if (optimum.is_null()) {
    page.paragraph("The search is not over. <code>millstand study run</code> continues it.");
    return;
  }
  const std::string name = escaped(optimum["objective"]), kind = escaped(optimum["searched"]);
  page.table(input_table(document), "Inputs at the " + kind + " value of <code>" + name +
                                        "</code>, and how far each may move until the objective is 5 % worse.");
  page.table(result_table(document), "Results at the optimum, from its own row.");
  page.section("valley", "Valley of the optimum");
  const bool searched = optimum["searched_valley"].get<bool>();
  page.paragraph(searched
                     ? "Each input goes through its bounds; at each value the other inputs are searched again."
                     : "Each input goes through its bounds, all others stay at the optimum.");
  std::vector<std::string> drawings;
  for (std::size_t k = 0; k < document["keys"].size(); ++k) {
    drawings.push_back(valley_along(document, k));
    if (drawings.size() == 2 || k + 1 == document["keys"].size()) {
      page.figure(drawings, "Objective <code>" + name + "</code> along the valley.");
      drawings.clear();
    }
  }
  if (searched && document["keys"].size() > 1)
    for (std::size_t k = 0; k < document["keys"].size(); ++k)
      page.table(valley_table(document, k),
                 "The other inputs along <code>" + escaped(document["keys"][k]["name"]) + "</code>.");
  page.section("search", "Progress of the search", Depth::expert);
  page.figure({progress(document)}, "Objective of each row that the search asked for, valley included.");
}
}  // namespace mill::report
