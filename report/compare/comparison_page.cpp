#include "core/base/files.h"
#include "report/compare/comparison.h"
#include "report/front/html.h"
#include "report/page/curves.h"
#include "report/page/page.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include "report/results/names.h"
#include "report/results/tables.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace mill::report {
namespace {
const char *const page_title = "comparison";

/// A curve that is drawn once for all runs.
struct SharedCurve {
  const CurveKind *kind;
  Column x, y;
  const char *x_words, *y_words;
};

const SharedCurve shared_curves[] = {
    {&curve::stand_modulus, {"load", "kN"}, {"tangent", "kN/mm"}, "rolling force", "mill modulus"},
    {&curve::contact, {"load", "kN"}, {"tangent", "kN/mm"}, "load", "stiffness, tangent"},
    {&curve::contact_barrel, {"z", "mm"}, {"line_load", "kN/mm"}, "along the barrel", "line load"},
    {&curve::bearing, {"load", "kN"}, {"displacement", "\u00b5m"}, "load", "displacement"},
    {&curve::chatter_speed, {"speed", "m/s"}, {"growth_rate", "1/s"}, "roll speed", "growth rate"},
};

const Pen run_pens[] = {Pen::dark, Pen::warm, Pen::dashed, Pen::dotted, Pen::chained, Pen::pale};

// Folder names distinguish runs of one case.
std::string label_of(const std::vector<Run> &runs, const std::size_t i)
{
  std::string name = runs[i].directory;
  while (!name.empty() && name.back() == '/')
    name.pop_back();
  name = name.substr(name.find_last_of('/') + 1);
  return name.empty() || name == "." ? runs[i].case_name + " " + std::to_string(i + 1) : name;
}

std::string heads(const std::vector<Run> &runs, const bool change)
{
  std::string cells;
  for (std::size_t i = 0; i < runs.size(); ++i)
    cells += "<th>" + escaped(label_of(runs, i)) + "</th>";
  return cells + (change ? "<th>largest change</th><th></th>" : "");
}

std::string input_table(const std::vector<Run> &runs, const std::vector<ChangedInput> &inputs)
{
  std::string rows;
  for (const ChangedInput &input : inputs) {
    rows += "<tr><th scope=\"row\"><code>" + escaped(input.key) + "</code></th>";
    for (const std::string &value : input.values)
      rows += "<td>" + (value.empty() ? std::string("\u2013") : escaped(shortened(value, 1500, 13.5))) + "</td>";
    rows += "</tr>\n";
  }
  return "<table class=\"results\"><thead><tr><th>input</th>" + heads(runs, false) + "</tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n";
}

// "given.K4, pass.0.load and 3 more"
std::string named_keys(const std::vector<std::string> &keys)
{
  constexpr std::size_t most = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(keys.size(), most); ++i)
    text += (i == 0 ? "" : ", ") + ("<code>" + escaped(keys[i]) + "</code>");
  return keys.size() > most ? text + " and " + std::to_string(keys.size() - most) + " more" : text;
}

std::string certainty_cell(const ChangedResult &changed)
{
  const std::string error = accuracy(changed.error);
  switch (changed.certainty) {
  case Certainty::certain:
    return changed.behind.empty() ? "certain: neither run states an error"
                                  : "certain: follows from " + named_keys(changed.behind);
  case Certainty::beyond:
    return "beyond the accuracy of the difference, " + error;
  case Certainty::within:
    return "within the accuracy of the difference, " + error;
  case Certainty::unknown:
    break;
  }
  return "accuracy not known";
}

std::string result_row(const ChangedResult &changed)
{
  const Result *any = nullptr;
  for (const Result *result : changed.results)
    any = any ? any : result;
  const bool sure = changed.certainty == Certainty::certain || changed.certainty == Certainty::beyond;
  std::string row = "<tr" + std::string(sure ? " class=\"beyond\"" : "") + "><th scope=\"row\"><code>" +
                    escaped(any->name) + "</code><small>" + escaped(meaning_of(any->name)) + "</small></th>";
  for (const Result *result : changed.results)
    row += "<td class=\"value\">" + (result ? value_cell(*result) : std::string("\u2013")) + "</td>";
  return row + "<td class=\"num\"><b>" + percent(changed.change) + "</b></td><td>" + certainty_cell(changed) +
         "</td></tr>\n";
}

std::string result_table(const std::vector<Run> &runs, const std::vector<ChangedResult> &results)
{
  std::string rows;
  for (const ChangedResult &changed : results)
    rows += result_row(changed);
  return "<table class=\"results\"><thead><tr><th>result</th>" + heads(runs, true) + "</tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n";
}

// One curve of all runs that have it; empty when only one has.
std::string curve_plot(const std::vector<Run> &runs, const SharedCurve &shared, const std::string &item)
{
  Plot plot;
  plot.title = shared.kind->title + (item.empty() ? std::string() : ", " + item);
  plot.x     = {shared.x_words, shared.x.unit};
  plot.y     = {shared.y_words, shared.y.unit};
  for (std::size_t i = 0; i < std::min(runs.size(), std::size(run_pens)); ++i)
    if (const Table *table = stored_curve(runs[i], *shared.kind, item))
      add_line(plot, *table, shared.x, shared.y, label_of(runs, i), run_pens[i]);
  return plot.lines.size() < 2 ? "" : svg_plot(plot);
}

std::vector<std::string> drawn_curves(const std::vector<Run> &runs)
{
  std::vector<std::string> drawings;
  for (const SharedCurve &shared : shared_curves) {
    const auto items = shared.kind->has_item ? items_of(runs.front(), *shared.kind) : std::vector<std::string>{""};
    for (const std::string &item : items)
      if (std::string plot = curve_plot(runs, shared, item); !plot.empty())
        drawings.push_back(std::move(plot));
  }
  return drawings;
}

std::string verdict_of(const std::vector<ChangedInput> &inputs, const std::vector<ChangedResult> &results)
{
  const auto number = [&](const Certainty certainty) {
    return std::count_if(results.begin(), results.end(),
                         [&](const ChangedResult &r) { return r.certainty == certainty; });
  };
  const auto counted = [](const std::size_t n, const char *what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
  };
  std::string text = counted(inputs.size(), "input") + (inputs.size() == 1 ? " differs; " : " differ; ");
  if (results.empty())
    return text + "all results that the runs share are equal.";
  text += counted(results.size(), "result") + (results.size() == 1 ? " differs" : " differ");
  std::string list;
  for (const auto &[certainty, words] :
       {std::pair(Certainty::certain, " with certainty"),
        std::pair(Certainty::beyond, " by more than the accuracy of the difference"),
        std::pair(Certainty::within, " within that accuracy"),
        std::pair(Certainty::unknown, " with an accuracy that is not known")})
    if (const auto n = number(certainty); n > 0)
      list += (list.empty() ? ": " : ", ") + std::to_string(n) + words;
  return text + list + ".";
}
}  // namespace

std::string comparison_page(const std::vector<Run> &runs, const std::vector<std::string> &resolved)
{
  const auto inputs  = changed_inputs(resolved);
  const auto results = changed_results(runs, resolved);
  Page page(runs.front());
  page.section("inputs", "What was changed", Depth::manager);
  if (inputs.empty())
    page.paragraph("The resolved cases are the same.");
  else
    page.table(input_table(runs, inputs), "Keys of <code>resolved.toml</code> that differ, defaults included.");
  page.section("changes", "Results", Depth::manager);
  if (results.empty())
    page.paragraph("Every result that two runs share is the same to 9 digits.");
  else
    page.table(result_table(runs, results),
               "Results that differ from " + escaped(label_of(runs, 0)) +
                   ": modulus, modes and critical speeds, then the others, the largest change first. What is the "
                   "same in both runs cancels in a difference: a difference that follows from given keys alone is "
                   "certain. Where an estimate is replaced, its interval is the accuracy; where models, meshes or "
                   "several values with errors of their own differ, the errors of both results are.");
  if (const auto drawings = drawn_curves(runs); !drawings.empty()) {
    page.section("curves", "The same curves", Depth::engineer);
    page.figure(drawings, "Curves that the runs share, on the same axes.");
  }
  std::string names;
  for (std::size_t i = 0; i < runs.size(); ++i)
    names += (i == 0 ? "" : ", ") + escaped(label_of(runs, i)) + " (run " + escaped(runs[i].manifest.run_id) + ")";
  const std::string head = "<header><h1>Comparison of " + std::to_string(runs.size()) +
                           " runs</h1></header>\n<p>" + names + "</p>\n<div class=\"verdict ok\"><p>" +
                           verdict_of(inputs, results) + "</p></div>\n";
  return html_document(page_title, runs.front(), page, head);
}

bool is_comparison_page(const std::string &text)
{
  return text.substr(0, text.find("<style>")).find(title_element(page_title)) != std::string::npos;
}

std::string comparison_of(const std::vector<std::string> &directories)
{
  std::vector<Run> runs;
  std::vector<std::string> resolved;
  for (const std::string &directory : directories) {
    runs.push_back(read_run(directory));
    resolved.push_back(text_if_readable(directory + "/resolved.toml").value_or(""));
  }
  return comparison_page(runs, resolved);
}
}  // namespace mill::report
