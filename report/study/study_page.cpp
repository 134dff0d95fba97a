#include "report/study/study_page.h"
#include "report/front/html.h"
#include "report/page/cells.h"
#include "report/page/page.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include "report/study/optimum_section.h"
#include "report/study/study_values.h"
#include "report/study/surrogate_section.h"
#include "report/twin/analysis/written_document.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

namespace mill::report {
namespace {
using nlohmann::json;

std::string in_words(const json &estimate, const double factor)
{
  return significant(factor * number_in(estimate["value"]), 5) + " <small>(" +
         significant(factor * number_in(estimate["low"]), 5) + " .. " +
         significant(factor * number_in(estimate["high"]), 5) + ")</small>";
}

std::string interval_table(const json &document)
{
  std::string rows;
  for (const json &result : document["results"]) {
    if (!result.contains("statistics"))
      continue;
    const json &s        = result["statistics"];
    const FloorUnit unit = floor_unit(result);
    std::string cells = cell(escaped(unit.sign)) + cell(significant(unit.factor * number_in(result["base"]), 5));
    for (const char *name : {"mean", "sd", "q025", "median", "q975"})
      cells += cell(in_words(s[name], unit.factor));
    rows += named_row(result["name"], cells);
  }
  return table_of("<th>result</th><th>unit</th><th>base case</th><th>mean</th><th>standard deviation</th>"
                  "<th>2.5 % below</th><th>median</th><th>2.5 % above</th>",
                  rows);
}

std::string histogram(const json &result)
{
  const json &s        = result["statistics"];
  const FloorUnit unit = floor_unit(result);
  const json &edges = s["bin_edges"], &shares = s["bin_shares"];
  if (shares.empty())
    return "";
  // The outline of the bars, since their axis is a quantity.
  Line outline{"", Eigen::VectorXd(Eigen::Index(2 * shares.size() + 2)),
               Eigen::VectorXd(Eigen::Index(2 * shares.size() + 2)), Pen::dark};
  Eigen::Index p = 0;
  outline.x[p] = unit.factor * edges[0].get<double>(), outline.y[p++] = 0;
  for (std::size_t b = 0; b < shares.size(); ++b)
    for (const std::size_t end : {b, b + 1})
      outline.x[p] = unit.factor * edges[end].get<double>(), outline.y[p++] = 100 * shares[b].get<double>();
  outline.x[p] = unit.factor * edges.back().get<double>(), outline.y[p] = 0;
  Plot plot;
  plot.width = pair_width;
  plot.x     = {result["name"], unit.sign.empty() ? "-" : unit.sign};
  plot.y     = {"rows", "%"};
  plot.lines = {outline};
  plot.marks = {{unit.factor * number_in(result["base"]), "base case"}};
  return svg_plot(plot);
}

// Indices with intervals: of Saltelli's rows, or of the polynomial.
bool with_indices(const json &result)
{
  return result.contains("sobol") || result.contains("chaos");
}

const json &indices_in(const json &result)
{
  return result.contains("sobol") ? result["sobol"] : result["chaos"];
}

// Shares of the variance: first-order indices where there are some, else those of the regression; empty for a
// result that is the same in every row.
const json &shares_of(const json &result)
{
  return with_indices(result) ? indices_in(result)["first"] : result["statistics"]["shares"];
}

std::string share_bars(const json &document, const json &result)
{
  const json &shares = shares_of(result);
  if (shares.empty())
    return "";
  const auto column = [](const json &values) {
    Eigen::VectorXd all(Eigen::Index(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
      all[Eigen::Index(i)] = 100 * number_in(values[i]);
    return all;
  };
  Plot plot;
  plot.width      = pair_width;
  plot.title      = result["name"];
  plot.x.quantity = "input";
  plot.x.unit     = "-";
  for (const json &key : document["keys"]) {
    const std::string name = key["name"];
    plot.x.categories.push_back(name.substr(name.rfind('.') + 1));
  }
  plot.y = {"share of the variance", "%"};
  plot.bars.push_back({with_indices(result) ? "alone (S)" : "by regression", column(shares), Pen::dark});
  if (with_indices(result))
    plot.bars.push_back({"with interactions (T)", column(indices_in(result)["total"]), Pen::pale});
  if (result.contains("linear"))
    plot.bars.push_back({"by derivatives", column(result["linear"]["shares"]), Pen::warm});
  return svg_plot(plot);
}

// For each result the inputs in the order in which knowing them helps, and what is left of the spread.
std::string ranking_table(const json &document)
{
  std::string rows;
  for (const json &result : document["results"]) {
    const json &shares = shares_of(result);
    if (shares.empty())
      continue;
    std::vector<std::size_t> order(shares.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
      return number_in(shares[a]) > number_in(shares[b]);
    });
    const FloorUnit unit = floor_unit(result);
    const double sd      = unit.factor * number_in(result["statistics"]["sd"]["value"]);
    const double linear =
        result.contains("linear") ? unit.factor * number_in(result["linear"]["sd"]) : std::nan("");
    std::string cells = cell(escaped(unit.sign)) + cell(significant(sd, 4)) + cell(significant(linear, 4));
    double known      = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      if (i >= order.size()) {
        cells += "<td></td>" + cell("");
        continue;
      }
      known += std::max(0.0, number_in(shares[order[i]]));
      cells += "<td><code>" + escaped(document["keys"][order[i]]["name"]) + "</code></td>" +
               cell(significant(sd * std::sqrt(std::max(0.0, 1 - known)), 3));
    }
    rows += named_row(result["name"], cells);
  }
  return table_of("<th>result</th><th>unit</th><th>standard deviation of the rows</th><th>linear estimate</th>"
                  "<th>measure first</th><th>spread that stays</th><th>then</th><th>spread that stays</th>",
                  rows);
}

std::string share_table(const json &document)
{
  std::string head = "<th>input</th><th>distribution</th>", rows;
  for (const json &result : document["results"])
    head += "<th>" + escaped(result["name"]) + "</th>";
  for (std::size_t k = 0; k < document["keys"].size(); ++k) {
    const json &key   = document["keys"][k];
    std::string cells = "<td>" + escaped(key["written"]) + "</td>";
    for (const json &result : document["results"]) {
      const json &shares = shares_of(result);
      std::string text   = shares.empty() ? "\u2013" : fixed(100 * number_in(shares[k]), 1) + " %";
      if (with_indices(result)) {
        const json &s = indices_in(result);
        text += " <small>(" + fixed(100 * number_in(s["first_low"][k]), 1) + " .. " +
                fixed(100 * number_in(s["first_high"][k]), 1) + "; T " + fixed(100 * number_in(s["total"][k]), 1) +
                ")</small>";
      }
      if (result.contains("linear"))
        text += " <small>linear " + fixed(100 * number_in(result["linear"]["shares"][k]), 1) + "</small>";
      cells += cell(text);
    }
    rows += named_row(key["name"], cells);
  }
  return table_of(head, rows);
}

std::string scatter(const json &document, const std::size_t r)
{
  const json &result = document["results"][r];
  const json &shares = shares_of(result);
  if (shares.empty() || document["points"].empty())
    return "";
  const auto k         = std::size_t(std::max_element(shares.begin(), shares.end()) - shares.begin());
  const FloorUnit unit = floor_unit(result);
  const auto n         = Eigen::Index(document["points"].size());
  Line dots{"", Eigen::VectorXd(n), Eigen::VectorXd(n), Pen::dark, true, false};
  for (Eigen::Index i = 0; i < n; ++i) {
    dots.x[i] = number_in(document["points"][std::size_t(i)]["inputs"][k]);
    dots.y[i] = unit.factor * number_in(document["points"][std::size_t(i)]["results"][r]);
  }
  const std::string key_unit = document["keys"][k]["unit"];
  Plot plot;
  plot.width = pair_width;
  plot.x     = {document["keys"][k]["name"], key_unit.empty() ? "-" : unit_sign(key_unit)};
  plot.y     = {result["name"], unit.sign.empty() ? "-" : unit.sign};
  plot.lines = {dots};
  return svg_plot(plot);
}

// Two results side by side; those that have no drawing are named below all others.
template <class Draw> void pairs_of_figures(Page &page, const json &document, const Draw &draw, const char *words)
{
  std::vector<std::string> drawings;
  std::string names, without;
  const auto finish = [&] {
    if (!drawings.empty())
      page.figure(drawings, words + names + ".");
    drawings.clear();
    names.clear();
  };
  for (std::size_t r = 0; r < document["results"].size(); ++r) {
    const json &result     = document["results"][r];
    const std::string name = "<code>" + escaped(result["name"]) + "</code>";
    std::string drawing    = draw(r);
    if (drawing.empty()) {
      without += (without.empty() ? "" : ", ") + name;
      continue;
    }
    drawings.push_back(std::move(drawing));
    names += (names.empty() ? "" : ", ") + name + ": " + escaped(result["meaning"]);
    if (drawings.size() == 2)
      finish();
  }
  finish();
  if (!without.empty())
    page.paragraph("Not drawn, since it has the same value in every row or no value: " + without + ".");
}

void drawn_sections(Page &page, const json &document)
{
  page.section("intervals", "Intervals of the results");
  page.table(interval_table(document),
             "Of all rows, in brackets 95 % intervals of the numbers themselves: more rows make "
             "them narrower. Between the columns 2.5 % below and 2.5 % above lie 95 % of the rows.");
  pairs_of_figures(
      page, document, [&](const std::size_t r) { return histogram(document["results"][r]); }, "Distribution of ");
  page.section("first", "Which input to measure better first");
  page.paragraph("The share of an input is the part of the variance that goes when this input is known exactly.");
  page.table(ranking_table(document),
             "Which input to know better first, and the standard deviation that is left then. The linear estimate "
             "takes the derivatives at the means of the inputs; where it differs from the rows, the result is not "
             "linear.");
  const bool indices = std::any_of(document["results"].begin(), document["results"].end(), with_indices);
  page.table(share_table(document), std::string(indices ? "First-order Sobol indices with 95 % intervals; T: with "
                                                          "interactions"
                                                        : "Shares by linear regression on the rows") +
                                        "; linear: by the derivatives.");
  pairs_of_figures(
      page, document, [&](const std::size_t r) { return share_bars(document, document["results"][r]); },
      "Shares of the variance. ");
  page.section("scatter", "Results over their strongest input");
  pairs_of_figures(
      page, document, [&](const std::size_t r) { return scatter(document, r); }, "Rows of ");
}

// Of an optimum, behind the start rows.
std::string searched_rows(const json &document)
{
  if (!document.contains("optimum") || document["optimum"].is_null())
    return "";
  return ", " + std::to_string(document["optimum"]["rows"].get<long>()) + " rows searched";
}

void failed_rows(Page &page, const json &document)
{
  std::string rows;
  for (const json &failure : document["failures"])
    rows += named_row(failure["row"], "<td>" + escaped(failure["reason"]) + "</td>");
  if (rows.empty())
    return;
  page.section("failed", "Rows without results");
  page.table(table_of("<th>row</th><th>reason</th>", rows), "Rows that failed, and why; the first hundred.");
}
}  // namespace

std::string study_page(const std::string &directory, const std::string &text)
{
  const json document = written_document(directory, "report.json", text, {"keys", "results", "method", "finished"},
                                         "run millstand study report again");
  Run run             = run_of(directory, document);
  const long rows = document["rows"].get<long>(), finished = document["finished"].get<long>(),
             failed = document["failed"].get<long>();
  run.status        = finished == rows && failed == 0 ? "ok" : "warnings";
  Page page(run);
  const bool drawn = !document["results"].empty() && document["results"][0].contains("statistics");
  optimum_section(page, document);
  if (drawn) {
    drawn_sections(page, document);
    surrogate_section(page, document);
  } else if (!document.contains("optimum"))
    page.paragraph("The rows of a grid or list are in <code>results.csv</code>.");
  failed_rows(page, document);
  const std::string head =
      "<header><h1>Study of " + escaped(run.case_name) + "</h1></header>\n<div class=\"verdict " + run.status +
      "\"><p>" + std::to_string(finished) + " of " + std::to_string(rows) + " rows finished" +
      searched_rows(document) + (failed > 0 ? ", " + std::to_string(failed) + " failed" : "") +
      ". Method: " + escaped(document["method"]) + ". Each row: " + escaped(document["work"]) +
      ".</p></div>\n<p>Case: <code>" + escaped(document["case_path"]) + "</code>, " + escaped(document["title"]) +
      ".</p>\n";
  return html_document(run.case_name + ", study", run, page, head);
}
}  // namespace mill::report
