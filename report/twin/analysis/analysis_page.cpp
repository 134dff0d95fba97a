#include "report/twin/analysis/analysis_page.h"
#include "core/base/files.h"
#include "report/front/html.h"
#include "report/page/page.h"
#include "report/plot/heat_map.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include "report/twin/analysis/mode_figures.h"
#include "report/twin/analysis/written_document.h"
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

namespace mill::report {
namespace {
using nlohmann::json;

constexpr std::size_t most_listed = 40;  // faults of the record in the table

std::string cell(const std::string &text)
{
  return "<td>" + text + "</td>";
}

std::string number_cell(const std::string &text)
{
  return "<td class=\"num\">" + text + "</td>";
}

std::string findings_table(const json &findings)
{
  std::string rows;
  for (const json &f : findings) {
    const double frequency = number_in(f["frequency"]), amplitude = number_in(f["amplitude"]);
    std::string evidence;
    for (const json &sentence : f["evidence"])
      evidence += (evidence.empty() ? "" : "<br/>") + escaped(sentence.get<std::string>());
    rows += "<tr><th scope=\"row\">" + escaped(f["kind"].get<std::string>()) + "</th>" +
            number_cell(std::isfinite(frequency) ? "<b>" + fixed(frequency, 2) + "</b>" : "\u2013") +
            number_cell(std::isfinite(frequency) ? fixed(number_in(f["interval"][0]), 2) + " \u2026 " +
                                                       fixed(number_in(f["interval"][1]), 2)
                                                 : "\u2013") +
            number_cell(std::isfinite(amplitude)
                            ? significant(amplitude, 3) + " " + escaped(unit_sign(f["unit"].get<std::string>()))
                            : "\u2013") +
            cell(escaped(f["channel"].get<std::string>())) +
            cell("<b>" + escaped(f["owner"].get<std::string>()) + "</b><br/>" + evidence) + "</tr>\n";
  }
  return "<table class=\"results\"><thead><tr><th>kind</th><th>frequency [Hz]</th><th>95 %</th><th>0-peak</th>"
         "<th>channel</th><th>source, and why</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n";
}

std::string cleaning_table(const json &events)
{
  std::string rows;
  for (std::size_t i = 0; i < std::min(events.size(), most_listed); ++i) {
    const json &e             = events[i];
    const std::string channel = e["channel"].get<std::string>();
    rows += "<tr><th scope=\"row\">" + escaped(channel.empty() ? "all" : channel) + "</th>" +
            cell(escaped(e["fault"].get<std::string>())) + number_cell(fixed(number_in(e["from"]), 4)) +
            number_cell(fixed(number_in(e["to"]), 4)) + number_cell(std::to_string(e["count"].get<long>())) +
            cell(escaped(e["done"].get<std::string>())) + "</tr>\n";
  }
  return "<table class=\"results\"><thead><tr><th>channel</th><th>fault</th><th>from [s]</th><th>to [s]</th>"
         "<th>samples</th><th>done</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n";
}

std::string convention_table(const json &conventions)
{
  std::string rows;
  for (const json &c : conventions) {
    const auto shown = [&](const char *key, const int digits) { return significant(number_in(c[key]), digits); };
    rows += "<tr><th scope=\"row\">" + escaped(c["channel"].get<std::string>()) + "</th>" +
            cell(escaped(c["quantity"].get<std::string>())) + cell(escaped(c["window"].get<std::string>())) +
            number_cell(shown("L", 6)) + number_cell(shown("segments", 4)) + number_cell(shown("enbw", 3)) +
            number_cell(shown("dof", 3)) +
            number_cell(significant(number_in(c["band"][0]), 2) + " \u2026 " +
                        significant(number_in(c["band"][1]), 2)) +
            number_cell(shown("bandwidth", 4)) + "</tr>\n";
  }
  return "<table "
         "class=\"results\"><thead><tr><th>channel</th><th>quantity</th><th>window</th><th>L</th><th>segments</th>"
         "<th>ENBW [Hz]</th><th>dof</th><th>95 % of a bin</th><th>used up to [Hz]</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n";
}

std::string value_table(const json &values)
{
  std::string rows;
  for (const auto &[name, v] : values.items()) {
    const double error = number_in(v["error_estimate"]);
    rows += "<tr><th scope=\"row\"><code>" + escaped(name) + "</code></th>" +
            number_cell("<b>" + significant(number_in(v["value"]), 4) + "</b>") +
            cell(escaped(unit_sign(v["unit"].get<std::string>()))) +
            cell(std::isfinite(error) ? "\u00b1" + significant(100 * error, 2) + " %" : "\u2013") +
            cell(escaped(v["source"].get<std::string>())) + cell(escaped(v["at"].get<std::string>())) + "</tr>\n";
  }
  return "<table "
         "class=\"results\"><thead><tr><th>result</th><th>value</th><th>unit</th><th>accuracy</th><th>source</th>"
         "<th>at</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n";
}

// What is marked in the spectrum: not an event, not what an envelope shows.
bool is_at_a_peak(const json &finding)
{
  const auto kind = kind_of(finding);
  return kind != FindingKind::alarm && kind != FindingKind::bearing && kind != FindingKind::bearing_fault &&
         kind != FindingKind::lost_samples;
}

std::string spectrum_drawing(const Table &table, const std::size_t column, const json &findings, const bool length)
{
  Plot plot;
  plot.title  = table.names[column];
  plot.width  = 1000;
  plot.height = 330;
  plot.x      = {length ? "per rolled length" : "frequency", length ? "1/m" : "Hz", Scale::logarithmic};
  plot.y      = {"density", unit_sign(table.units[column]), Scale::logarithmic};
  const Eigen::VectorXd &x = table.columns[0], &y = table.columns[column];
  plot.lines.push_back({"", x.tail(x.size() - 1), y.tail(y.size() - 1), Pen::dark});
  plot.x.low         = std::max(x[1], length ? x[1] : 1.0);
  const double least = y.tail(y.size() - 2).minCoeff(), most = y.maxCoeff();
  plot.y.low  = std::max(least, 1e-12 * most);
  plot.y.high = 2 * most;
  if (!length) {
    std::vector<double> marked;
    for (const json &f : findings)
      if (const double frequency = number_in(f["frequency"]);
          std::isfinite(frequency) && is_at_a_peak(f) && marked.size() < 12 &&
          std::none_of(marked.begin(), marked.end(),
                       [&](const double m) { return std::abs(m / frequency - 1) < 0.03; })) {
        plot.marks.push_back({frequency, fixed(frequency, 1)});
        marked.push_back(frequency);
      }
  }
  return svg_plot(plot);
}

// The map of one channel in decibel above its least level, so that cells are above zero.
std::string map_drawing(const Table &table, const std::size_t column)
{
  const Eigen::VectorXd *time = table.column("time"), *frequency = table.column("frequency");
  if (!time || !frequency || time->size() < 4)
    return "";
  Eigen::Index rows = 1;
  while (rows < time->size() && (*time)[rows] == (*time)[0])
    ++rows;
  const Eigen::Index frames = time->size() / rows;
  if (frames < 2)
    return "";
  HeatMap map;
  map.title    = table.names[column];
  map.x        = {"time", "s"};
  map.y        = {"frequency", "Hz"};
  map.quantity = "level over the least";
  map.unit     = "dB";
  map.at_x.resize(frames);
  map.at_y = frequency->head(rows);
  map.value.resize(frames, rows);
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index j = 0; j < frames; ++j) {
    map.at_x[j] = (*time)[j * rows];
    for (Eigen::Index i = 0; i < rows; ++i) {
      map.value(j, i) = 10 * std::log10(std::max(1e-300, table.columns[column][j * rows + i]));
      if (table.columns[column][j * rows + i] > 0)
        least = std::min(least, map.value(j, i));
    }
  }
  map.value.array() -= least;
  return heat_map(map);
}

// Largest peak of a channel with its source, or that nothing stands out: only where the account says so.
std::string largest_of(const json &account)
{
  const json &largest    = account["largest"];
  const double frequency = number_in(largest["frequency"]);
  if (std::isfinite(frequency))
    return fixed(frequency, 2) + " Hz, " + significant(number_in(largest["amplitude"]), 3) + " " +
           escaped(unit_sign(largest["unit"].get<std::string>())) + ", " +
           fixed(number_in(largest["over_floor"]), 0) +
           " dB over the floor: " + escaped(largest["source"].get<std::string>());
  return account["only_noise"].get<bool>() ? "nothing stands out of the noise" : "no peak above the threshold";
}

std::string account_table(const json &accounts)
{
  std::string rows;
  for (const json &one : accounts) {
    const auto share = [&](const char *key) { return number_cell(fixed(number_in(one[key]), 1)); };
    rows += "<tr><th scope=\"row\">" + escaped(one["channel"].get<std::string>()) + "</th>" + share("lines") +
            share("families") + share("modes") + share("floor") + share("not_explained") + cell(largest_of(one)) +
            "</tr>\n";
  }
  return "<table class=\"results\"><thead><tr><th>channel</th><th>lines [%]</th><th>families [%]</th><th>modes "
         "[%]</th><th>noise floor [%]</th><th>not explained [%]</th><th>largest "
         "peak</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n";
}

bool only_noise(const json &document)
{
  if (!document.contains("account") || document["account"].empty())
    return false;
  const auto &accounts = document["account"];
  return std::all_of(accounts.begin(), accounts.end(),
                     [](const json &one) { return one["only_noise"].get<bool>(); });
}

std::string verdict(const json &document)
{
  std::size_t urgent = 0, unowned = 0;
  for (const json &f : document["findings"]) {
    const auto kind         = kind_of(f);
    const std::string owner = f["owner"];
    urgent += kind && is_urgent(*kind);
    unowned += owner.rfind("source not identified", 0) == 0;
  }
  const std::size_t n = document["findings"].size();
  std::string text =
      std::to_string(n) + (n == 1 ? " finding, " : " findings, ") +
      (urgent == 0 ? std::string("no alarm, no mode near instability and no bearing fault among them")
                   : std::to_string(urgent) + " of them alarms, modes near instability or bearing faults");
  if (!document["stand"].is_null())
    text += "; the source of " + std::to_string(unowned) + " of them is not identified";
  return "<div class=\"verdict " + std::string(urgent == 0 ? "ok" : "warnings") + "\"><p>" + text +
         ".</p></div>\n";
}

std::string head_of_page(const json &document)
{
  const json &record = document["record"];
  std::string text = "<header><h1>Record " + escaped(document["case"].get<std::string>()) + "</h1></header>\n<p>" +
                     escaped(record["format"].get<std::string>()) + ", " +
                     significant(number_in(record["duration"]), 4) + " s at " +
                     significant(number_in(record["rate"]), 6) + " Hz";
  if (!document["stand"].is_null())
    text += "; stand " + escaped(document["stand"]["case"].get<std::string>()) + ", " +
            escaped(document["stand"]["source"].get<std::string>());
  return text + "</p>\n" + verdict(document);
}

void spectra(Page &page, const json &document, const std::map<std::string, Table> &tables)
{
  page.section("spectra", "Spectra");
  if (const auto table = tables.find("spectrum"); table != tables.end())
    for (std::size_t c = 1; c < table->second.columns.size(); ++c) {
      if (!(table->second.columns[c].maxCoeff() > 0))
        continue;  // a constant speed
      page.figure(
          {spectrum_drawing(table->second, c, document["findings"], false)},
          "One-sided density of " + escaped(table->second.names[c]) +
              ", Hann window, half-overlapping segments, the mean of each taken off. Marks are findings; length "
              "and number of segments and the noise bandwidth stand in the table below.");
    }
  page.table(convention_table(document["conventions"]),
             "Convention of each spectrum. Amplitudes of findings are 0-peak.");
  if (const auto table = tables.find("distance"); table != tables.end())
    for (std::size_t c = 1; c < table->second.columns.size(); ++c)
      page.figure({spectrum_drawing(table->second, c, document["findings"], true)},
                  "The same over the rolled length: what is locked to the speed is a line here, what is fixed is "
                  "smeared.");
  if (const auto table = tables.find("waterfall"); table != tables.end())
    for (std::size_t c = table->second.column("speed") ? 3 : 2; c < table->second.columns.size(); ++c)
      if (const std::string drawing = map_drawing(table->second, c); !drawing.empty())
        page.figure({drawing}, "Spectrum of " + escaped(table->second.names[c]) +
                                   " over time; each cell is the largest bin of its group.");
}
}  // namespace

namespace {
const Table *table_of(const std::map<std::string, Table> &tables, const std::string &name)
{
  const auto table = tables.find(name);
  return table == tables.end() || table->second.columns.empty() || table->second.columns[0].size() == 0
             ? nullptr
             : &table->second;
}

void modes(Page &page, const std::map<std::string, Table> &tables)
{
  const Table *undriven = table_of(tables, "modes"), *forced = table_of(tables, "modes_h1"),
              *response = table_of(tables, "h1"), *poles = table_of(tables, "poles");
  if (response) {
    page.section("forced-modes", "Modes from the response to the force");
    if (forced)
      page.table(
          forced_mode_rows(*forced),
          "Poles fitted to H1 about each resonance, the window of the segments taken into account. Intervals "
          "are 95 %, from what the fit leaves. Only those that both halves of the record show are findings.");
    page.figure({response_drawing(*response, forced)},
                "Response per force, estimator H1 = S_yF / S_FF; marks are confirmed modes. Numbers: "
                "<code>h1.csv</code>.");
    page.figure({coherence_drawing(*response)},
                "Share of each channel that follows the recorded force. Where it is low, noise or another source "
                "moves the channel.");
  }
  if (undriven || poles)
    page.section("modes", "Modes from the response alone");
  if (undriven)
    page.table(mode_rows(*undriven),
               "Poles that half of the model orders show. The scatter is about twice the least "
               "standard error, three times for a "
               "close pair. Only those that both halves of the record show are findings.");
  if (poles)
    if (const std::string drawing = stability_drawing(*poles, table_of(tables, "singular")); !drawing.empty())
      page.figure({drawing},
                  "Poles over the order of the model, behind them the first singular value of the cross "
                  "spectra (logarithmic, scaled to the height). A mode is a column of stable dots; a "
                  "column alone does not prove a mode; confirmed are those that both halves show.");
}
}  // namespace

std::string analysis_page(const std::string &directory, const std::string &text,
                          const std::map<std::string, Table> &tables)
{
  const json document =
      written_document(directory, "analysis.json", text, {"findings", "record"}, "analyse the record again");
  const Run run = run_of(directory, document);
  Page page(run);
  page.section("findings", "What the record shows", Depth::manager);
  if (document.contains("account"))
    page.table(
        account_table(document["account"]),
        "Account of the variance of every channel, 100 % together, and its largest peak. A candidate is a peak "
        "above the noise floor by more than noise reaches in one record of a thousand; what became of each is in "
        "<code>candidates.csv</code>.");
  if (document["findings"].empty())
    page.paragraph(only_noise(document) ? "Nothing stands out of the noise."
                                        : "No finding; what the account leaves unexplained is stated above.");
  else
    page.table(findings_table(document["findings"]),
               "Findings: modes, then families of lines, lines and resonances, what is locked to the speed, onset "
               "and bearings. The "
               "interval is that of the frequency.");
  if (!document["notes"].empty()) {
    page.heading("Limits of this analysis");
    page.html(list_of(document["notes"]));
  }
  page.section("cleaning", "What was wrong with the record");
  if (document["cleaning"].empty())
    page.paragraph("No gap, no missing value, no clipping, no constant value. Offset and drift were taken "
                   "off; they are among the values.");
  else
    page.table(cleaning_table(document["cleaning"]),
               "Faults with their time, at most " + std::to_string(most_listed) + " of " +
                   std::to_string(document["cleaning"].size()) +
                   "; all of them: <code>analysis.json</code>. Nothing was changed but what this table says, and "
                   "offset and drift.");
  spectra(page, document, tables);
  modes(page, tables);
  page.section("values", "All values", Depth::expert);
  page.table(value_table(document["values"]), "Values of <code>analysis.json</code>, SI.");
  return html_document(run.case_name + ", record", run, page, head_of_page(document));
}

std::string analysis_page(const std::string &directory)
{
  return analysis_page(directory, read_text(directory + "/analysis.json"),
                       written_tables(directory, {"spectrum", "waterfall", "distance", "modes", "poles",
                                                  "singular", "h1", "modes_h1"}));
}
}  // namespace mill::report
