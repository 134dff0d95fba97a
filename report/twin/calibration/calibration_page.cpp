#include "report/twin/calibration/calibration_page.h"
#include "core/base/files.h"
#include "core/records/calibration_status.h"
#include "report/front/html.h"
#include "report/page/page.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/twin/analysis/written_document.h"
#include "report/twin/calibration/figures.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill::report {
namespace {
using nlohmann::json;

std::string data(const std::string &text, const char *kind = "")
{
  return std::string("<td") + kind + ">" + text + "</td>";
}

std::string figure_cell(const std::string &text)
{
  return data(text, " class=\"num\"");
}

std::string table_of(const std::string &head, const std::string &rows)
{
  return "<table class=\"results\"><thead><tr>" + head + "</tr></thead>\n<tbody>\n" + rows + "</tbody></table>\n";
}

/// A number as the files say it, with a true minus.
std::string change(const json &unknown, const char *which)
{
  std::string text = unknown["shown"][which].get<std::string>();
  if (!text.empty() && text[0] == '-')
    text = "−" + text.substr(1);
  return text;
}

std::string unknowns_table(const json &unknowns)
{
  std::string rows;
  for (const json &u : unknowns) {
    const bool identified = is_identified(u);
    rows += "<tr><th scope=\"row\"><code>" + escaped(u["name"].get<std::string>()) + "</code></th>" +
            figure_cell(u.value("taken", identified) ? "<b>" + change(u, "value") + "</b>" : "kept") +
            figure_cell(change(u, "low") + " … " + change(u, "high")) +
            figure_cell(u["name"] == "delay" ? significant(1e3 * number_in(u["prior_sd"]), 3) + " ms"
                                             : significant(100 * number_in(u["prior_sd"]), 2) + " %") +
            figure_cell(significant(number_in(u["shrink"]), 2)) + figure_cell(fixed(number_in(u["moved"]), 2)) +
            data(identified ? "identified" : escaped(u["why_not"].get<std::string>())) + "</tr>\n";
  }
  return table_of("<th>unknown</th><th>change of the case</th><th>95 % interval</th><th>deviation before</th>"
                  "<th>share left</th><th>moved, in deviations</th><th>result</th>",
                  rows);
}

std::string modes_table(const json &modes)
{
  std::string rows;
  int number = 0;
  for (const json &mode : modes) {
    std::string names;
    for (const json &name : mode["rests_on"])
      names += (names.empty() ? "" : ", ") + escaped(name.get<std::string>());
    rows += "<tr><th scope=\"row\">" + std::to_string(++number) + "</th>" +
            figure_cell(significant(number_in(mode["before"]), 5)) +
            figure_cell("<b>" + significant(number_in(mode["frequency"]), 5) + "</b>") +
            figure_cell(significant(number_in(mode["interval"][0]), 5) + " … " +
                        significant(number_in(mode["interval"][1]), 5)) +
            data(mode["determined"].get<bool>() ? "determined" : "not determined; depends on " + names) +
            "</tr>\n";
  }
  return table_of("<th>mode</th><th>before [Hz]</th><th>after [Hz]</th><th>95 % interval [Hz]</th><th>by these "
                  "records</th>",
                  rows);
}

std::string correlation_table(const json &unknowns, const json &correlation)
{
  std::string head = "<th></th>", rows;
  for (const json &u : unknowns)
    head += "<th>" + escaped(u["name"].get<std::string>()) + "</th>";
  for (std::size_t i = 0; i < correlation.size(); ++i) {
    rows += "<tr><th scope=\"row\">" + escaped(unknowns[i]["name"].get<std::string>()) + "</th>";
    for (std::size_t j = 0; j < correlation[i].size(); ++j) {
      const double r         = number_in(correlation[i][j]);
      const std::string text = fixed(r, 2);
      rows += figure_cell(i != j && std::abs(r) > 0.9 ? "<b>" + text + "</b>" : text);
    }
    rows += "</tr>\n";
  }
  return table_of(head, rows);
}

std::string bands_table(const json &bands)
{
  std::string rows;
  for (const char *which : {"fit", "check"})
    for (const json &band : bands[which]) {
      if (!band["counts"].get<bool>() || number_in(band["ratio"]) < 0.9 * number_in(band["limit"]))
        continue;
      rows += "<tr>" + data(which) + data(escaped(band["sensor"].get<std::string>())) +
              figure_cell(fixed(number_in(band["centre"]), 1)) +
              figure_cell(significant(number_in(band["energy"]), 2)) +
              figure_cell(significant(number_in(band["left"]), 3)) +
              figure_cell(significant(number_in(band["floor"]), 3)) +
              figure_cell("<b>" + fixed(number_in(band["ratio"]), 3) + "</b>") +
              figure_cell(fixed(number_in(band["limit"]), 3)) + "</tr>\n";
    }
  return rows.empty() ? ""
                      : table_of("<th>records</th><th>sensor</th><th>third octave [Hz]</th><th>share of the energy"
                                 "</th><th>residual</th><th>noise</th><th>ratio</th><th>limit</th>",
                                 rows);
}

bool force_recorded(const json &document)
{
  return document.value("force_recorded", true);
}

/// Sensors of the third octaves: each, or all together.
json sensors_of(const json &bands)
{
  json sensors = json::array();
  for (const json &band : bands)
    if (std::find(sensors.begin(), sensors.end(), band["sensor"]) == sensors.end())
      sensors.push_back(band["sensor"]);
  return sensors;
}

std::string head_of(const json &document)
{
  std::string files;
  for (const json &file : document["records"])
    files += (files.empty() ? "" : ", ") + escaped(file.get<std::string>());
  std::string text =
      "<header><h1>Calibration of " + escaped(document["case"].get<std::string>()) + "</h1></header>\n<p>" +
      escaped(document["stand"].get<std::string>()) + "; records " + files + ": " +
      significant(number_in(document["seconds"][0]), 3) + " s fitted, " +
      significant(number_in(document["seconds"][1]), 3) + " s held back as a check; " +
      fixed(number_in(document["band"][0]), 0) + " to " + fixed(number_in(document["band"][1]), 0) + " Hz</p>\n" +
      (force_recorded(document) ? "" : "<p>" + escaped(document["without_force"].get<std::string>()) + ".</p>\n");
  const auto status = choice_named<CalibrationStatus>(document["status"].get<std::string>());
  int identified    = 0;
  for (const json &u : document["unknowns"])
    identified += is_identified(u);
  const std::string count =
      fmt::format("{} of {} unknowns are identified by these records", identified, document["unknowns"].size());
  if (status == CalibrationStatus::ok)
    return text + "<div class=\"verdict ok\"><p>" + count +
           "; the calibrated stand explains the check records within the noise and a model error of " +
           fmt::format("{:.3g}", 100 * document.value("model_error", 0.05)) + " % per third octave.</p></div>\n";
  if (status == CalibrationStatus::agrees)
    return text + "<div class=\"verdict ok\"><p>The case agrees with these records already. No "
                  "calibrated case was written.</p></div>\n";
  return text + "<div class=\"verdict warnings\"><p>" +
         (status == CalibrationStatus::accepted ? "Refused, but written because of <code>--accept</code>: "
                                                : "Refused, no calibrated case was written: ") +
         "the reasons are below. The parameters are not valid for this stand.</p></div>\n";
}

void add_unknowns(Page &page, const json &document)
{
  page.section("unknowns", "Results", Depth::manager);
  if (!document["refusals"].empty()) {
    page.heading("Reasons for the refusal");
    page.html(list_of(document["refusals"]));
  }
  page.table(
      unknowns_table(document["unknowns"]),
      document.value("written", "").empty()
          ? "Unknowns of the fit in which all are free, with their 95 % intervals. No case was written. The "
            "share left is the deviation after the fit over the deviation before."
          : "Unknowns. The change is that of the calibrated case, in which an unknown that is not identified "
            "keeps its value unless that value contradicts the records. The interval covers this value and the "
            "fit in which all unknowns are free. The "
            "share left is the deviation after the fit over the deviation before.");
  page.figure({moved_drawing(document["unknowns"])}, "Change of each unknown in standard deviations of its prior. "
                                                     "Beyond 3 the records contradict the case, and the "
                                                     "calibration is refused.");
  if (document.contains("modes") && !document["modes"].empty())
    page.table(
        modes_table(document["modes"]),
        "Frequencies of the calibrated stand. A mode is determined where its interval reaches at most 2 % to "
        "both sides. The interval of one that is not says what the records allow.");
  if (!document["unseen"].empty()) {
    page.heading("Combinations that these records do not determine");
    page.html(list_of(document["unseen"]));
  }
  if (number_in(document["kept_deviance"]) > 0)
    page.paragraph("Keeping the unknowns that are not identified at their values raises the deviance by " +
                   significant(number_in(document["kept_deviance"]), 2) + ".");
}

void add_check(Page &page, const json &document, const std::map<std::string, Table> &tables)
{
  page.section("check", "Before and after on the check records", Depth::manager);
  const json &values = document["values"];
  page.paragraph("Misfit " + significant(number_in(values["misfit.check.after"]["value"]), 4) + ", before " +
                 significant(number_in(values["misfit.check.before"]["value"]), 4) +
                 "; 1 corresponds to the noise of the fitted records. No sample of the check was fitted.");
  if (const auto table = tables.find("response"); table != tables.end())
    for (const std::string &drawing : response_drawings(table->second, document["sensors"]))
      page.figure({drawing},
                  std::string(force_recorded(document)
                                  ? "Acceleration per bite force: the check records"
                                  : "Acceleration: the check records, with the density of the force "
                                    "that suits them best,") +
                      " compared with the stand before and after. "
                      "The measured line is averaged over Hann segments, which lowers its sharp resonances.");
  if (const auto table = tables.find("force"); table != tables.end())
    page.figure(
        {force_drawing(table->second)},
        "Estimated density of the force of the fitted records, which was not recorded. It is smooth over a third "
        "octave.");
  page.section("residuals", "Residual by third octave");
  const json &bands = document["bands"];
  page.figure(
      {residual_drawing(bands["fit"], sensors_of(bands["fit"]), "fitted records"),
       residual_drawing(bands["check"], sensors_of(bands["check"]), "check records")},
      std::string("Residual of the stand over the residual of any ") +
          (force_recorded(document) ? "linear model with this force" : "single force") +
          " and the model error, relative to the limit 1.05 + 4/√bins. Above 1 the model is wrong in this band. A "
          "band with less than 1 % of the energy is not shown, since it cannot refuse.");
  if (document.contains("levels"))
    page.figure(
        {level_drawing(document["levels"]["fit"], "fitted records"),
         level_drawing(document["levels"]["check"], "check records")},
        "Level of the force in narrow bands over its surroundings: 1 where the resonances of the stand are "
        "those of the records and the force is smooth.");
  if (const std::string table = bands_table(document["bands"]); !table.empty())
    page.table(table, "Third octaves at 0.9 of their limit and above.");
}

void add_minima(Page &page, const json &document, const std::map<std::string, Table> &tables)
{
  page.section("profiles", "Profiles and other minima");
  if (const auto table = tables.find("profiles"); table != tables.end()) {
    const auto drawings = profile_drawings(table->second);
    for (std::size_t i = 0; i < drawings.size(); i += 3)
      page.figure({drawings.begin() + long(i), drawings.begin() + long(std::min(i + 3, drawings.size()))},
                  "Deviance along a spring, with all other unknowns fitted again. The interval ends where it "
                  "reaches 3.84. "
                  "With a second minimum below 9 the spring is not identified. Cut at 60.");
  } else
    page.paragraph("No spring was scanned, since the fit determines all of them to a hundredth of their prior or "
                   "better.");
  std::string basins;
  for (const json &basin : document["basins"])
    basins += "<tr><th scope=\"row\">" + escaped(basin["name"].get<std::string>()) + "</th>" +
              figure_cell(percent(std::expm1(number_in(basin["theta"])))) +
              figure_cell(significant(number_in(basin["deviance"]), 3)) + "</tr>\n";
  if (!basins.empty())
    page.table(table_of("<th>unknown</th><th>change there</th><th>deviance</th>", basins),
               "Other minima found by the scans.");
  page.table(correlation_table(document["unknowns"], document["correlation"]),
             "Correlation of the unknowns after the fit; beyond 0.9 in bold.");
}
}  // namespace

std::string calibration_page(const std::string &directory, const std::string &text,
                             const std::map<std::string, Table> &tables)
{
  const json document =
      written_document(directory, "calibration.json", text, {"unknowns", "refusals"}, "calibrate again");
  const Run run = run_of(directory, document);
  Page page(run);
  add_unknowns(page, document);
  add_check(page, document, tables);
  add_minima(page, document, tables);
  if (!document["notes"].empty()) {
    page.section("notes", "Notes on the records");
    page.html(list_of(document["notes"]));
  }
  return html_document("Calibration of " + run.case_name, run, page, head_of(document));
}

std::string calibration_page(const std::string &directory)
{
  return calibration_page(directory, read_text(directory + "/calibration.json"),
                          written_tables(directory, {"response", "profiles", "force"}));
}
}  // namespace mill::report
