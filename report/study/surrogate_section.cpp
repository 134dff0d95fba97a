#include "report/study/surrogate_section.h"
#include "report/page/cells.h"
#include "report/plot/heat_map.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/study/study_values.h"
#include "report/twin/analysis/written_document.h"
#include <algorithm>

namespace mill::report {
namespace {
using nlohmann::json;

Eigen::VectorXd column_of(const json &values, const double factor)
{
  Eigen::VectorXd all(Eigen::Index(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    all[Eigen::Index(i)] = factor * number_in(values[i]);
  return all;
}

std::string error_table(const json &results)
{
  std::string rows;
  for (const json &result : results) {
    const json &chaos    = result["chaos"];
    const FloorUnit unit = floor_unit(result);
    const auto share     = [&](const char *name) { return significant(100 * number_in(chaos[name]), 2) + " %"; };
    rows +=
        named_row(result["name"], cell(escaped(unit.sign)) + cell(std::to_string(chaos["degree"].get<int>())) +
                                      cell(std::to_string(chaos["terms"].get<int>())) +
                                      cell(significant(unit.factor * number_in(chaos["mean"]), 5)) +
                                      cell(significant(unit.factor * number_in(chaos["sd"]), 4)) +
                                      cell(share("leave_one_out")) +
                                      cell(share("held_out") + " <small>(" +
                                           std::to_string(chaos["held_out_rows"].get<long>()) + " rows)</small>"));
  }
  return table_of("<th>result</th><th>unit</th><th>degree</th><th>terms</th><th>mean</th><th>standard "
                  "deviation</th><th>leave-one-out error</th><th>error of held-out rows</th>",
                  rows);
}

std::string prediction(const json &result)
{
  const json &chaos    = result["chaos"];
  const FloorUnit unit = floor_unit(result);
  const auto computed  = column_of(chaos["computed"], unit.factor),
             predicted = column_of(chaos["predicted"], unit.factor);
  if (computed.size() < 3)
    return "";
  Plot plot;
  plot.width      = pair_width;
  plot.x          = axis_of_result(result);
  plot.y          = plot.x;
  plot.x.quantity = "computed " + plot.x.quantity;
  plot.y.quantity = "by the polynomial";
  const Eigen::Vector2d ends(computed.minCoeff(), computed.maxCoeff());
  plot.lines = {{"equal", ends, ends, Pen::pale}, {"held-out rows", computed, predicted, Pen::dark, true, false}};
  return svg_plot(plot);
}

std::string map_of(const json &document, const json &result)
{
  const json &map = result["chaos"]["map"];
  if (map["height"].empty())
    return "";
  const FloorUnit unit = floor_unit(result);
  HeatMap drawing;
  drawing.width  = pair_width;
  drawing.height = 330;
  drawing.x      = axis_of_key(document["keys"][map["x_key"].get<std::size_t>()]);
  drawing.y      = axis_of_key(document["keys"][map["y_key"].get<std::size_t>()]);
  drawing.at_x   = column_of(map["x"], 1);
  drawing.at_y   = column_of(map["y"], 1);
  drawing.value.resize(drawing.at_x.size(), drawing.at_y.size());
  for (Eigen::Index j = 0; j < drawing.at_y.size(); ++j)
    drawing.value.col(j) = column_of(map["height"][std::size_t(j)], unit.factor);
  // Blank is at and below zero: the scale begins at the lowest value.
  const double lowest = drawing.value.minCoeff();
  drawing.value.array() += 1e-9 * (drawing.value.maxCoeff() - lowest) - lowest;
  drawing.quantity = result["name"].get<std::string>() + " above " + significant(lowest, 5);
  drawing.unit     = unit.sign.empty() ? "-" : unit.sign;
  return heat_map(drawing);
}

template <class Draw> void figures_by_two(Page &page, const json &results, const Draw &draw, const char *caption)
{
  for (std::size_t r = 0; r < results.size(); r += 2) {
    std::vector<std::string> drawings;
    for (std::size_t i = r; i < std::min(r + 2, results.size()); ++i)
      drawings.push_back(draw(results[i]));
    page.figure(drawings, caption);
  }
}
}  // namespace

void surrogate_section(Page &page, const json &document)
{
  json fitted = json::array();
  for (const json &result : document["results"])
    if (result.contains("chaos"))
      fitted.push_back(result);
  if (fitted.empty())
    return;
  page.section("surrogate", "Polynomial in place of the model");
  page.table(
      error_table(fitted),
      "Each result as a polynomial of the inputs. An error is the mean squared difference over the variance "
      "of the result: of each row by the fit to all others, and of rows that took no part in the fit. Below 1 "
      "% the shares of the variance are those of the model.");
  figures_by_two(page, fitted, prediction,
                 "Rows that took no part in the fit: the dots lie on the line where the polynomial is right.");
  figures_by_two(
      page, fitted, [&](const json &result) { return map_of(document, result); },
      "Map over the two inputs with the largest shares, all others at their means.");
}
}  // namespace mill::report
