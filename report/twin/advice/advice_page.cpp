#include "report/twin/advice/advice_page.h"
#include "core/base/files.h"
#include "core/base/si_unit.h"
#include "core/records/advice_goal.h"
#include "report/front/html.h"
#include "report/page/page.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include "report/twin/analysis/written_document.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

namespace mill::report {
namespace {
using nlohmann::json;

constexpr std::size_t most_bars = 12;

std::string text_of(const json &value)
{
  return escaped(value.get<std::string>());
}

std::string text_cell(const std::string &text)
{
  return "<td>" + text + "</td>";
}

std::string figure_cell(const std::string &text)
{
  return "<td class=\"num\">" + text + "</td>";
}

std::string signed_percent(const json &value)
{
  const double part = number_in(value);
  return std::isfinite(part) ? percent(part) : "\u2013";
}

// "force +10.8 %; torque +12 %; ..": what is worth a word, then the mode that moves most.
std::string effects_of(const json &action)
{
  std::string text;
  for (const json &effect : action["effects"]) {
    const double value     = number_in(effect["value"]);
    const std::string unit = effect["unit"];
    if (!std::isfinite(value) || (is_in(unit, SiUnit::one) && std::abs(value) < 5e-4))
      continue;
    text +=
        (text.empty() ? "" : "; ") + text_of(effect["name"]) + "\u00a0" +
        (is_in(unit, SiUnit::one) ? percent(value) : significant(value, 4) + "\u00a0" + escaped(unit_sign(unit)));
  }
  if (text.empty())
    text = "none above 0.05 %";
  const std::string modes = text_of(action["modes"]);
  return text + (modes.empty() ? "" : "<br/>modes: " + modes);
}

std::string lines_of(const json &sentences)
{
  std::string text;
  for (const json &sentence : sentences)
    text += (text.empty() ? "" : "<br/>") + text_of(sentence);
  return text;
}

bool is_above(const json &action)
{
  return action["against"].empty();
}

std::string others_of(const json &action)
{
  std::string text;
  for (const json &other : action["in_other_models"])
    text +=
        (text.empty() ? "" : "<br/>") + text_of(other["name"]) + ": <b>" + signed_percent(other["value"]) + "</b>";
  const std::string remarks = lines_of(action["remarks"]);
  return text + (text.empty() || remarks.empty() ? "" : "<br/>") + remarks;
}

bool has_other_models(const json &document)
{
  return std::any_of(document["actions"].begin(), document["actions"].end(),
                     [](const json &action) { return !action["in_other_models"].empty(); });
}

std::string action_row(const json &a, const bool above, const bool models, const bool margin)
{
  std::string name = "<b>" + text_of(a["name"]) + "</b>";
  if (const std::string means = text_of(a["means"]); !means.empty())
    name += "<br/><small>" + means + "</small>";
  const double spread    = number_in(a["change_sd"]);
  const std::string anew = signed_percent(a["change"]),
                    sd   = std::isfinite(spread) ? "<br/>\u00b1" + significant(100 * spread, 2) : "";
  std::string row =
      "<tr>" + figure_cell(above ? std::to_string(a["rank"].get<int>()) : "\u2013") + text_cell(name);
  if (models)
    row += figure_cell("<b>" + signed_percent(a["verified_change"]) + "</b>") + figure_cell(anew + sd);
  else
    row += figure_cell("<b>" + anew + "</b>" + sd);
  row += figure_cell(signed_percent(a["first_order"])) +
         figure_cell(a["pair"].get<bool>() ? signed_percent(a["one_by_one"]) : "") + text_cell(effects_of(a));
  if (margin)
    row += text_cell(a.value("reaches_margin", false) ? "reached" : "not reached");
  const std::string others = others_of(a), against = lines_of(a["against"]);
  return row + text_cell(above ? others : "<b>" + against + "</b>" + (others.empty() ? "" : "<br/>" + others)) +
         "</tr>\n";
}

std::string action_table(const json &document, const bool above)
{
  const bool margin = document["goal"]["kind"] == word_of(RatedGoal::critical_speed),
             models = has_other_models(document);
  std::string rows;
  for (const json &action : document["actions"])
    if (is_above(action) == above)
      rows += action_row(action, above, models, margin);
  const std::string wide = "<th style=\"min-width:16em\">";
  return "<table class=\"results\"><thead><tr><th>rank</th>" + wide + "action</th>" +
         (models ? "<th>decisive</th><th>six masses</th>" : "<th>recomputed</th>") +
         "<th>first order</th><th>one after the other</th>" + wide + "side effects</th>" +
         (margin ? "<th>wanted margin</th>" : "") + wide +
         (above ? "what it rests on" : "why it is below the line") + "</th></tr></thead>\n<tbody>\n" + rows +
         "</tbody></table>\n";
}

std::string bar_drawing(const json &document)
{
  Plot plot;
  plot.width  = 1000;
  plot.height = 330;
  std::vector<double> really, slope;
  for (const json &a : document["actions"])
    if (is_above(a) && really.size() < most_bars) {
      really.push_back(100 * number_in(a["verified_change"]));
      slope.push_back(100 * number_in(a["first_order"]));
      plot.x.categories.push_back(std::to_string(really.size()));
    }
  if (really.empty())
    return "";
  const auto column = [](const std::vector<double> &v) {
    return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(v.data(), Eigen::Index(v.size())));
  };
  plot.x.quantity = "rank of the action";
  plot.x.unit     = "-";
  plot.y          = {"change", "%"};
  plot.bars.push_back(
      {has_other_models(document) ? "decisive, in the detailed model" : "recomputed", column(really), Pen::dark});
  plot.bars.push_back({"linear estimate", column(slope), Pen::pale});
  return svg_plot(plot);
}

// All columns of a table over its first one.
std::string curves_drawing(const Table &table, const Axis &x, const Axis &y, const std::vector<Mark> &marks)
{
  Plot plot;
  plot.width  = 1000;
  plot.height = 360;
  plot.x      = x;
  plot.y      = y;
  plot.marks  = marks;
  const Pen pens[]{Pen::pale, Pen::dark, Pen::warm, Pen::dashed, Pen::dotted};
  const bool single = table.names.size() == 2;
  for (std::size_t c = 1; c < table.columns.size(); ++c)
    plot.lines.push_back({table.names[c], table.columns[0], table.columns[c],
                          single ? Pen::dark : pens[std::min<std::size_t>(c - 1, 4)]});
  return svg_plot(plot);
}

// Figures and tunings are those of the six masses, also where a detailed model decides.
std::string of_six_masses(const json &document)
{
  return has_other_models(document)
             ? " These are the six masses; the decisive values, in the detailed model, are in the table "
               "of the actions."
             : "";
}

void before_and_after(Page &page, const json &document, const std::map<std::string, Table> &tables)
{
  if (const auto entry = tables.find("spectrum"); entry != tables.end() && entry->second.columns.size() > 1) {
    const Table &table = entry->second;
    double most        = 0;
    for (std::size_t c = 1; c < table.columns.size(); ++c)
      most = std::max(most, table.columns[c].maxCoeff());
    Axis y{"acceleration", unit_sign(table.units[1]), Scale::logarithmic};
    y.low = 1e-5 * most, y.high = 2 * most;
    Axis x{"frequency", "Hz", Scale::logarithmic};
    x.low = std::max(table.columns[0][0], 1e-2 * table.columns[0][table.columns[0].size() - 1]);
    page.section("spectrum", "Before and after");
    page.figure({curves_drawing(table, x, y, {})}, "Acceleration of the place as it is and with the best actions "
                                                   "on the stand. Amplitude per newton of bite force; "
                                                   "with a measured force the root of the density." +
                                                       of_six_masses(document));
  }
  if (const auto table = tables.find("growth"); table != tables.end() && table->second.columns.size() > 1) {
    page.section("growth", "Before and after");
    page.figure(
        {curves_drawing(table->second, {"speed of the rolls", "m/s"}, {"growth rate", "1/s"}, {})},
        "Growth rate of the least stable mode over the speed: vibration grows above zero. Every point has its "
        "own steady bite.");
  }
}

std::string tuned_rows(const json &dampers)
{
  std::string rows;
  for (const json &t : dampers) {
    const json &best = t["best"], &start = t["start"];
    const auto shown = [](const json &value, const int digits) { return significant(number_in(value), digits); };
    rows += "<tr><th scope=\"row\">" + text_of(t["action"]) + "</th>" +
            text_cell("mode " + std::to_string(t["mode"].get<int>()) + ", " +
                      fixed(number_in(t["mode_frequency"]), 1) + " Hz; effective mass " +
                      shown(t["effective_mass"], 5) + " kg") +
            figure_cell(shown(t["mass"], 4)) + figure_cell(fixed(100 * number_in(t["mass_ratio"]), 2)) +
            figure_cell("<b>" + fixed(number_in(best["frequency"]), 1) + "</b><br/>" +
                        fixed(number_in(start["frequency"]), 1)) +
            figure_cell("<b>" + fixed(100 * number_in(best["damping"]), 2) + "</b><br/>" +
                        fixed(100 * number_in(start["damping"]), 2)) +
            figure_cell("<b>" + signed_percent(best["change"]) + "</b><br/>" + signed_percent(start["change"])) +
            figure_cell(signed_percent(t["detuned_5_percent"][0]) + "<br/>" +
                        signed_percent(t["detuned_5_percent"][1])) +
            figure_cell(shown(t["stiffness"], 4)) + figure_cell(shown(t["damper"], 4)) + "</tr>\n";
  }
  return "<table class=\"results\"><thead><tr><th>tuned damper</th><th>made for</th><th>mass [kg]</th><th>ratio "
         "[%]</th><th>frequency [Hz]</th><th>damping [%]</th><th>change</th><th>5 % too low, too "
         "high</th><th>spring "
         "[N/m]</th><th>damper [N s/m]</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n";
}

void tuned_section(Page &page, const json &document, const std::map<std::string, Table> &tables)
{
  if (document["tuned_dampers"].empty())
    return;
  page.section("tuned", "Tuned damper");
  page.table(
      tuned_rows(document["tuned_dampers"]),
      "In bold the tuning of least level, below it that of the closed form for one mode under white force." +
          of_six_masses(document));
  if (const auto table = tables.find("detuning"); table != tables.end() && table->second.columns.size() > 1)
    page.figure({curves_drawing(table->second, {"frequency of the damper off by", "%"},
                                {"change of the level", "%"}, {{-5, "-5 %"}, {5, "+5 %"}})},
                "What is left when the damper is out of tune: its frequency drifts with temperature, mass and the "
                "errors of the stand.");
}

void slope_section(Page &page, const json &document)
{
  if (document["slopes"].empty())
    return;
  std::string rows;
  for (const json &slope : document["slopes"])
    rows += "<tr><th scope=\"row\">" + text_of(slope["name"]) + "</th>" +
            figure_cell(significant(number_in(slope["slope"]), 4)) + "</tr>\n";
  page.section("slopes", "Slopes", Depth::expert);
  page.table(
      "<table class=\"results\"><thead><tr><th>number</th><th>percent per percent</th></tr></thead>\n<tbody>\n" +
          rows + "</tbody></table>\n",
      "How the goal follows each number, exact at the stand as it is, largest first. Good for small changes "
      "only.");
}

void value_section(Page &page, const json &values)
{
  std::string rows;
  for (const auto &[name, v] : values.items()) {
    const double error = number_in(v["error_estimate"]);
    std::string checks;
    if (v.contains("checks"))
      for (const json &check : v["checks"])
        checks += (checks.empty() ? "" : "<br/>") + text_of(check["name"]) + ": " +
                  significant(number_in(check["value"]), 4);
    rows += "<tr><th scope=\"row\"><code>" + escaped(name) + "</code></th>" +
            figure_cell("<b>" + significant(number_in(v["value"]), 5) + "</b>") +
            text_cell(escaped(unit_sign(v["unit"].get<std::string>()))) +
            text_cell(std::isfinite(error) ? "\u00b1" + significant(100 * error, 2) + " %" : "\u2013") +
            text_cell(text_of(v["source"])) + text_cell(checks) + "</tr>\n";
  }
  page.section("values", "All values", Depth::expert);
  page.table("<table class=\"results\"><thead><tr><th>result</th><th>value</th><th>unit</th><th>accuracy</th>"
             "<th>source</th><th>compared with</th></tr></thead>\n<tbody>\n" +
                 rows + "</tbody></table>\n",
             "Values of <code>advice.json</code>, SI.");
}

void what_if_section(Page &page, const json &document)
{
  if (!document.contains("what_ifs") || document["what_ifs"].empty())
    return;
  std::string rows;
  for (const json &one : document["what_ifs"])
    rows += "<tr><th scope=\"row\">" + text_of(one["name"]) + "</th>" +
            figure_cell("<b>" + signed_percent(one["change"]) + "</b>") +
            figure_cell(signed_percent(one["first_order"])) + text_cell(effects_of(one)) + "</tr>\n";
  page.section("what-ifs", "What if the damping were another one");
  page.table(
      "<table class=\"results\"><thead><tr><th>number</th><th>recomputed</th><th>first order</th><th>side "
      "effects</th></tr></thead>\n<tbody>\n" +
          rows + "</tbody></table>\n",
      "A damping ratio is a property of the whole stand: it is measured, and no single part of the mill sets "
      "it. These lines show how far the answer depends on it.");
}

void action_sections(Page &page, const json &document)
{
  const auto &actions = document["actions"];
  const auto above    = std::count_if(actions.begin(), actions.end(), is_above);
  page.section("actions", "Ranked actions", Depth::manager);
  if (above > 0) {
    if (const std::string drawing = bar_drawing(document); !drawing.empty())
      page.figure({drawing}, "Change of the goal by each action, recomputed for the changed mill, and the linear "
                             "estimate. Where the two differ, the linear estimate is wrong.");
    page.table(
        action_table(document, true),
        "Single actions at their bounds and pairs of the best three, ranked by the recomputed change. A pair is "
        "computed as a pair; the sum of its two actions is shown for comparison.");
  } else
    page.paragraph("No action that was tried helps within the limits.");
  if (std::size_t(above) < actions.size()) {
    page.heading("Rejected actions");
    page.table(action_table(document, false), "Actions that were tried and do not help, or violate a limit.");
  }
}
}  // namespace

std::string advice_page(const std::string &directory, const std::string &text,
                        const std::map<std::string, Table> &tables)
{
  const json document =
      written_document(directory, "advice.json", text, {"actions", "goal"}, "run millstand advise again");
  const Run run = run_of(directory, document);
  Page page(run);
  action_sections(page, document);
  what_if_section(page, document);
  before_and_after(page, document, tables);
  tuned_section(page, document, tables);
  slope_section(page, document);
  if (!document["notes"].empty()) {
    page.section("notes", "What was not computed, and why");
    page.html(list_of(document["notes"]));
  }
  value_section(page, document["values"]);
  const bool any         = std::any_of(document["actions"].begin(), document["actions"].end(), is_above);
  const std::string head = "<header><h1>Advice for " + escaped(run.case_name) +
                           "</h1></header>\n<p>Goal: " + text_of(document["goal"]["question"]) +
                           ". Stand: " + text_of(document["stand"]) + ".</p>\n<div class=\"verdict " +
                           (any ? "ok" : "warnings") + "\"><p>" + text_of(document["goal"]["answer"]) +
                           "</p></div>\n<p>This page is advice: nothing is sent to the mill.</p>\n";
  return html_document(run.case_name + ", advice", run, page, head);
}

std::string advice_page(const std::string &directory)
{
  return advice_page(directory, read_text(directory + "/advice.json"),
                     written_tables(directory, {"spectrum", "detuning", "growth"}));
}
}  // namespace mill::report
