#include "report/study/sweep_page.h"
#include "core/base/files.h"
#include "core/base/si_unit.h"
#include "report/front/html.h"
#include "report/page/cells.h"
#include "report/page/page.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include "report/twin/analysis/written_document.h"
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

namespace mill::report {
namespace {
using nlohmann::json;

constexpr double half_page = 450;  // px, of two drawings side by side

constexpr std::size_t most_lines = 8, most_rows = 500;

const Pen line_pens[] = {Pen::dark,    Pen::warm,        Pen::dashed,      Pen::dotted,
                         Pen::chained, Pen::warm_dashed, Pen::dark_dashed, Pen::pale_dashed};

// A result in the unit of the mill floor, with its factor.
struct ShownUnit {
  double factor;
  std::string sign;
};
ShownUnit shown_unit(const json &document, const std::size_t result)
{
  const json &column     = document["results"][result];
  const std::string unit = column["unit"];
  double largest         = std::abs(number_in(column["base"]));
  for (const json &row : document["rows"])
    if (const double value = std::abs(number_in(row["results"][result])); value > largest || std::isnan(largest))
      largest = value;
  if (!(largest > 0))
    return {1, unit_sign(unit)};
  const Shown shown = engineering(largest, unit);
  return {shown.value / largest, shown.unit.empty() ? "-" : unit_sign(shown.unit)};
}

// The first key with two numbers or more is the axis; without one the rows are.
std::size_t axis_key(const json &document)
{
  for (std::size_t k = 0; k < document["keys"].size(); ++k) {
    std::map<double, int> numbers;
    for (const json &row : document["rows"])
      if (const double number = number_in(row["numbers"][k]); std::isfinite(number))
        numbers[number]++;
    if (numbers.size() > 1)
      return k;
  }
  return document["keys"].size();
}

// "work_roll.crown = 50 um" of all keys but the axis.
std::string other_values(const json &document, const json &row, const std::size_t axis)
{
  std::string text;
  for (std::size_t k = 0; k < document["keys"].size(); ++k)
    if (k != axis)
      text += (text.empty() ? "" : ", ") + document["keys"][k]["name"].get<std::string>() + " = " +
              row["values"][k].get<std::string>();
  return text;
}

std::string unit_of_axis(const json &key)
{
  const std::string unit = key["unit"];
  return unit.empty() ? "-" : unit_sign(unit);
}

std::string drawing_of(const json &document, const std::size_t result, const std::size_t axis, bool &cut)
{
  const ShownUnit unit = shown_unit(document, result);
  std::map<std::string, std::map<double, double>> lines;
  std::vector<std::string> order;
  double number = 0;
  for (const json &row : document["rows"]) {
    ++number;
    const std::string label = axis < document["keys"].size() ? other_values(document, row, axis) : "";
    if (!lines.count(label))
      order.push_back(label);
    const double x  = axis < document["keys"].size() ? number_in(row["numbers"][axis]) : number;
    lines[label][x] = unit.factor * number_in(row["results"][result]);
  }
  Plot plot;
  plot.width = half_page;
  plot.title = document["results"][result]["name"];
  plot.x     = axis < document["keys"].size()
                   ? Axis{document["keys"][axis]["name"], unit_of_axis(document["keys"][axis])}
                   : Axis{"row", "-"};
  plot.y     = {plot.title, unit.sign};
  cut        = order.size() > most_lines;
  for (std::size_t i = 0; i < std::min(order.size(), most_lines); ++i) {
    const auto &points = lines[order[i]];
    Line line{order[i], Eigen::VectorXd(Eigen::Index(points.size())), Eigen::VectorXd(Eigen::Index(points.size())),
              line_pens[i]};
    Eigen::Index p = 0;
    for (const auto &[x, y] : points) {
      line.x[p]   = x;
      line.y[p++] = y;
    }
    line.markers = points.size() <= 40;
    line.joined  = axis < document["keys"].size();
    plot.lines.push_back(line);
  }
  return svg_plot(plot);
}

void curves(Page &page, const json &document)
{
  const std::size_t axis = axis_key(document);
  page.section("curves", "Results over the inputs");
  for (std::size_t r = 0; r < document["results"].size(); r += 2) {
    std::vector<std::string> drawings;
    std::string caption;
    bool cut = false;
    for (std::size_t i = r; i < std::min(r + 2, document["results"].size()); ++i) {
      const json &column = document["results"][i];
      drawings.push_back(drawing_of(document, i, axis, cut));
      const double error = number_in(column["error_estimate"]);
      caption += (caption.empty() ? "" : " ") + std::string("<code>") + escaped(column["name"]) +
                 "</code>: " + escaped(column["meaning"]) +
                 (std::isfinite(error) ? " (base case " + accuracy(error) + ")" : "") + ".";
    }
    if (cut)
      caption += " The first " + std::to_string(most_lines) + " combinations of the other keys are drawn.";
    page.figure(drawings, caption);
  }
}

std::string table_of_rows(const json &document)
{
  std::string head = "<th>row</th>", rows;
  for (const json &key : document["keys"])
    head += "<th>" + escaped(key["name"]) + "</th>";
  std::vector<ShownUnit> units;
  for (std::size_t r = 0; r < document["results"].size(); ++r) {
    units.push_back(shown_unit(document, r));
    head += "<th>" + escaped(document["results"][r]["name"]) + escaped(after_name(units.back().sign)) + "</th>";
  }
  std::size_t number = 0;
  for (const json &row : document["rows"]) {
    if (++number > most_rows)
      break;
    std::string cells;
    for (const json &value : row["values"])
      cells += cell(escaped(value));
    for (std::size_t r = 0; r < units.size(); ++r)
      cells += cell(significant(units[r].factor * number_in(row["results"][r]), 5));
    rows += named_row(std::to_string(number), cells);
  }
  return table_of(head, rows);
}

void failures(Page &page, const json &document)
{
  std::string rows;
  std::size_t number = 0;
  for (const json &row : document["rows"]) {
    ++number;
    if (!row["failure"].get<std::string>().empty())
      rows += named_row(std::to_string(number), "<td>" +
                                                    escaped(other_values(document, row, document["keys"].size())) +
                                                    "</td><td>" + escaped(row["failure"]) + "</td>");
  }
  if (rows.empty())
    return;
  page.section("failed", "Rows without results");
  page.table(table_of("<th>row</th><th>inputs</th><th>reason</th>", rows),
             "Rows that were not computed, and why.");
}

std::size_t failed_rows(const json &document)
{
  return std::size_t(std::count_if(document["rows"].begin(), document["rows"].end(),
                                   [](const json &row) { return !row["failure"].get<std::string>().empty(); }));
}
}  // namespace

std::string sweep_page(const std::string &directory, const std::string &text)
{
  const json document = written_document(directory, "sweep.json", text, {"keys", "results", "rows", "work"},
                                         "run millstand sweep again");
  Run run             = run_of(directory, document);
  const auto failed   = failed_rows(document);
  run.status          = failed == 0 ? "ok" : "warnings";
  Page page(run);
  curves(page, document);
  page.section("rows", "All rows");
  const std::size_t n = document["rows"].size();
  page.table(table_of_rows(document),
             "Every row in the order of <code>results.csv</code>." +
                 (n > most_rows ? " The first " + std::to_string(most_rows) + " of " + std::to_string(n) + "."
                                : std::string()));
  failures(page, document);
  const std::string head = "<header><h1>Sweep of " + escaped(run.case_name) +
                           "</h1></header>\n<div class=\"verdict " + run.status + "\"><p>" + std::to_string(n) +
                           (n == 1 ? " row, " : " rows, ") +
                           (failed == 0 ? "all computed" : std::to_string(failed) + " without results") + ", in " +
                           significant(number_in(document["seconds"]), 2) +
                           " s. Each row: " + escaped(document["work"]) + ".</p></div>\n<p>Case: <code>" +
                           escaped(document["case_path"]) + "</code>, " + escaped(document["title"]) + ".</p>\n";
  return html_document(run.case_name + ", sweep", run, page, head);
}

std::string sweep_page(const std::string &directory)
{
  return sweep_page(directory, read_text(directory + "/sweep.json"));
}
}  // namespace mill::report
