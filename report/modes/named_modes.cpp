#include "report/modes/named_modes.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_stand.h"
#include "report/modes/model_data.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/names.h"
#include "report/results/tables.h"
#include <cmath>

namespace mill::report {
namespace {
// Results of one name in both states of the gap; nullptr: none.
struct ModeRow {
  const Result *rolling = nullptr, *open = nullptr, *share = nullptr;
};

ModeRow row_of(const Run &run, const std::string &key)
{
  ModeRow mode{run.find(row::modes::frequency.of("", key)), run.find(row::modes::frequency.of(family::open, key)),
               run.find(row::modes::gap_share.of("", key))};
  if (!mode.rolling)
    mode.share = run.find(row::modes::gap_share.of(family::open, key));
  return mode;
}

std::string number_cell(const Result *frequency)
{
  return "<td class=\"num\">" +
         (frequency ? "<b>" + frequency_text(frequency->value, frequency->error_estimate) + "</b>" : "\u2013") +
         "</td>";
}

std::string table_row(const ModeRow &row)
{
  const Result &mode    = row.rolling ? *row.rolling : *row.open;
  const NamedMode named = named_mode(mode);
  std::string others;
  for (const Check &check : mode.checks)
    others += (others.empty() ? "" : ", ") + check.name + " " + fixed(check.value, 1);
  return "<tr><th scope=\"row\">" + escaped(named.name) + "</th>" + number_cell(row.rolling) +
         number_cell(row.open) + "<td class=\"num\">" + (row.share ? fixed(100 * row.share->value, 1) : "\u2013") +
         "</td><td>" + accuracy_cell(mode) + "</td><td>" + escaped(named.why) + "</td><td>" +
         (others.empty() ? "\u2013" : escaped(others)) + "</td></tr>\n";
}
}  // namespace

std::string named_mode_table(const Run &run)
{
  std::string body;
  for (const Result &mode : run.results) {
    const auto id = result_id(mode.name);
    if (!id || !id->is_of(row::modes::frequency))
      continue;
    const bool is_open = !id->place("open").empty();
    const ModeRow row  = row_of(run, id->place("mode"));
    if (!is_open || !row.rolling)  // a mode of both states has one row
      body += table_row(row);
  }
  if (body.empty())
    return "";
  const bool both = run.find(result_name({family::open, "f1"}));
  return std::string("<table><thead><tr><th>mode</th><th>") + (both ? "rolling" : "open") +
         " [Hz]</th><th>open, K4 = 0 [Hz]</th><th>share of the gap [%]</th><th>accuracy</th><th>why this name</th>"
         "<th>same name elsewhere [Hz]</th></tr></thead>\n<tbody>\n" +
         body + "</tbody></table>\n";
}

std::string folded_modes(const Run &run)
{
  const ModelData data          = read_models(run.directory);
  const ComparedModel *detailed = data.stored ? data.detailed() : nullptr;
  if (!detailed)
    return "";
  std::string body;
  int count = 0;
  for (const ModelMode &mode : detailed->modes)
    if (!mode.listed && mode.frequency <= data.frequency_limit) {
      ++count;
      body += "<tr><th scope=\"row\">" + escaped(mode.name) + "</th><td class=\"num\">" +
              fixed(mode.frequency, 1) + "</td><td>" + escaped(mode.decided) + "</td></tr>\n";
    }
  if (count == 0)
    return "";
  return "<details><summary>" + std::to_string(count) + (count == 1 ? " further mode" : " further modes") +
         " that neither gap nor sensors see</summary>\n<table><thead><tr><th>mode</th><th>frequency [Hz]</th>"
         "<th>why this name</th></tr></thead>\n<tbody>\n" +
         body + "</tbody></table></details>\n";
}
}  // namespace mill::report
