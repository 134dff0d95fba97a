#include "report/twin/calibration/plan_page.h"
#include "core/base/files.h"
#include "report/front/html.h"
#include "report/page/page.h"
#include "report/twin/analysis/written_document.h"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill::report {
namespace {
using nlohmann::json;

std::string number_cell(const json &value)
{
  return "<td class=\"num\">" + (value.is_number() ? fmt::format("{}", value.get<double>()) : std::string("–")) +
         "</td>";
}

std::string plan_table(const std::string &head, const std::string &rows)
{
  return "<table class=\"results\"><thead><tr>" + head + "</tr></thead>\n<tbody>\n" + rows + "</tbody></table>\n";
}

std::string plan_rows(const json &unknowns, const bool with_frequency)
{
  std::string rows;
  for (const json &u : unknowns)
    rows += "<tr><th scope=\"row\"><code>" + escaped(u["name"].get<std::string>()) + "</code></th>" +
            (with_frequency ? number_cell(u["frequency_Hz"]) : "") + number_cell(u["prior_sd"]) +
            number_cell(u["sd"]) + number_cell(u["shrink"]) + "<td>" +
            (u["identified"].get<bool>() ? "identified" : "not identified") + "</td></tr>\n";
  return rows;
}

const char *const columns_after =
    "<th>deviation before [-]</th><th>deviation after [-]</th><th>share left [-]</th><th>result</th>";

std::string record_table(const json &record)
{
  std::string rows;
  for (const auto &[name, value] : record.items()) {
    std::string text = value.dump();
    rows += "<tr><th scope=\"row\"><code>" + escaped(name) + "</code></th><td class=\"num\">" + escaped(text) +
            "</td></tr>\n";
  }
  return plan_table("<th>assumed record</th><th>value</th>", rows);
}

void add_sensors(Page &page, const json &next)
{
  if (next.empty())
    return;
  page.section("sensors", "Further sensors", Depth::manager);
  std::string rows;
  for (const json &sensor : next)
    rows += "<tr><th scope=\"row\"><code>" + escaped(sensor["place"].get<std::string>()) + "</code></th>" +
            number_cell(sensor["gain_nats"]) + "<td><code>" + escaped(sensor["improves"].get<std::string>()) +
            "</code></td>" + number_cell(sensor["shrink"]) + number_cell(sensor["shrink_now"]) + "</tr>\n";
  page.table(plan_table("<th>place</th><th>information gained [nat]</th><th>improves most</th><th>share left</th>"
                        "<th>share left now</th>",
                        rows),
             "One more sensor at each place that has no sensor; the one that adds most comes first.");
}
}  // namespace

std::string plan_page(const std::string &directory, const std::string &text)
{
  const json document = written_document(directory, "plan.json", text, {"unknowns", "record"}, "plan again");
  const Run run       = run_of(directory, document);
  Page page(run);
  page.section("unknowns", "Unknowns", Depth::manager);
  page.table(
      plan_table(std::string("<th>unknown</th>") + columns_after, plan_rows(document["unknowns"], false)),
      "Standard deviation of the logarithm of each unknown before and after the planned record. Up to half of "
      "the deviation left, the unknown is identified.");
  if (!document["ratios"].empty())
    page.table(plan_table(std::string("<th>unknown</th><th>mode [Hz]</th>") + columns_after,
                          plan_rows(document["ratios"], true)),
               "A damping ratio for each mode, in place of the common one.");
  if (!document["unseen"].empty()) {
    page.heading("Combinations that this record would not determine");
    page.html(list_of(document["unseen"]));
  }
  add_sensors(page, document["next_sensors"]);
  page.section("record", "Assumed record");
  page.table(record_table(document["record"]), "Change these values by the options of --plan.");
  if (!document["notes"].empty()) {
    page.section("notes", "Notes");
    page.html(list_of(document["notes"]));
  }
  std::string sensors;
  for (const json &sensor : document["sensors"])
    sensors += (sensors.empty() ? "" : ", ") + escaped(sensor.get<std::string>());
  return html_document("Plan for " + run.case_name, run, page,
                       "<header><h1>Plan of a record for " + escaped(run.case_name) + "</h1></header>\n<p>" +
                           escaped(document["stand"].get<std::string>()) + "; sensors at " + sensors + "</p>\n");
}

std::string plan_page(const std::string &directory)
{
  return plan_page(directory, read_text(directory + "/plan.json"));
}
}  // namespace mill::report
