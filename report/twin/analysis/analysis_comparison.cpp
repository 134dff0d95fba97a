#include "report/twin/analysis/analysis_comparison.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/si_unit.h"
#include "core/records/compared_bands.h"
#include "report/front/html.h"
#include "report/page/page.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include "report/twin/analysis/written_document.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

namespace mill::report {
namespace {
using nlohmann::json;

constexpr std::array<Pen, 4> pens{Pen::dark, Pen::warm, Pen::dashed, Pen::dotted};

struct ComparedAnalysis {
  std::string folder;
  json document;
  std::optional<Table> spectrum;
};

ComparedAnalysis read_analysis(const std::string &directory)
{
  ComparedAnalysis one{directory,
                       written_document(directory, "analysis.json", read_text(directory + "/analysis.json"),
                                        {"findings", "record"}, "analyse the record again"),
                       {}};
  auto tables = written_tables(directory, {"spectrum"});
  if (const auto table = tables.find("spectrum"); table != tables.end())
    one.spectrum = std::move(table->second);
  return one;
}

const Eigen::VectorXd *density_of(const ComparedAnalysis &one, const std::string &channel)
{
  return one.spectrum ? one.spectrum->column(channel) : nullptr;
}

std::string unit_of_channel(const ComparedAnalysis &one, const std::string &channel)
{
  for (const json &convention : one.document["conventions"])
    if (convention["channel"] == channel)
      return convention["unit"].get<std::string>();
  return "";
}

// Root mean square of the velocity between two frequencies; NaN where the channel is not a vibration or ends
// below.
double band_velocity(const ComparedAnalysis &one, const std::string &channel, const ComparedBand &band)
{
  const Eigen::VectorXd *density = density_of(one, channel);
  const std::string unit         = unit_of_channel(one, channel);
  if (!density || (!is_in(unit, SiUnit::acceleration) && !is_in(unit, SiUnit::speed)))
    return std::nan("");
  const Eigen::VectorXd &f = one.spectrum->columns[0];
  if (f.size() < 3 || f[f.size() - 1] < band.high)
    return std::nan("");
  double square = 0;
  for (Eigen::Index k = 1; k < f.size(); ++k)
    if (f[k] >= band.low && f[k] <= band.high) {
      const double w = is_in(unit, SiUnit::acceleration) ? 2 * M_PI * f[k] : 1;
      square += (*density)[k] * (f[1] - f[0]) / (w * w);
    }
  return std::sqrt(square);
}

std::vector<std::string> shared_channels(const std::vector<ComparedAnalysis> &all)
{
  std::vector<std::string> names;
  for (const json &convention : all.front().document["conventions"]) {
    const auto name = convention["channel"].get<std::string>();
    if (std::all_of(all.begin(), all.end(), [&](const auto &one) { return density_of(one, name) != nullptr; }))
      names.push_back(name);
  }
  return names;
}

// A level with its relative standard error; NaN: not stated.
struct Level {
  double value, error;
};

Level band_level(const ComparedAnalysis &one, const std::string &channel, const ComparedBand &band)
{
  Level level{band_velocity(one, channel, band), std::nan("")};
  for (const json &convention : one.document["conventions"])
    if (convention["channel"] == channel && convention.contains("level_errors"))
      for (const json &entry : convention["level_errors"])
        if (number_in(entry["band"][0]) == band.low && number_in(entry["band"][1]) == band.high)
          level.error = number_in(entry["error"]);
  return level;
}

Level amplitude_of(const json &finding)
{
  return {number_in(finding["amplitude"]),
          finding.contains("amplitude_error") ? number_in(finding["amplitude_error"]) : std::nan("")};
}

// "-63 % ± 4 %", 95 %; the interval is left out where an analysis states no error.
std::string change_text(const Level &before, const Level &after)
{
  const double percent = 100 * (after.value / before.value - 1);
  if (!(before.value > 0) || !std::isfinite(percent))
    return "\u2013";
  const double within     = 1.96 * 100 * after.value / before.value * std::hypot(before.error, after.error);
  const int digits        = within < 1 ? 1 : 0;
  const std::string shown = (percent >= 0 ? "+" : "\u2212") + fixed(std::abs(percent), digits) + " %";
  if (!std::isfinite(within))
    return shown;
  return shown + " \u00b1 " + fixed(within, digits) + " %" +
         (std::abs(percent) > within ? "" : " (not significant)");
}

// "velocity in the third-octave band -63 % (upper_work_roll)": of the band and channel that changed most.
std::string first_sentence(const std::vector<ComparedAnalysis> &all, const std::vector<std::string> &channels)
{
  std::string text = "no channel is a vibration: levels are not compared";
  double largest   = -1;
  for (const ComparedBand &band : compared_bands)
    for (const std::string &channel : channels) {
      const Level before = band_level(all.front(), channel, band), after = band_level(all.back(), channel, band);
      const double change = std::abs(std::log(after.value / before.value));
      if (std::isfinite(change) && change > largest) {
        largest = change;
        text    = std::string("velocity in the ") + band.name + " " + change_text(before, after) + " (" +
               escaped(channel) + ")";
      }
    }
  return text;
}

std::string band_table(const std::vector<ComparedAnalysis> &all, const std::vector<std::string> &channels)
{
  std::string head = "<th>channel</th><th>band</th>", rows;
  for (const ComparedAnalysis &one : all)
    head += "<th>" + escaped(one.folder) + " [mm/s]</th>";
  for (const std::string &channel : channels)
    for (const ComparedBand &band : compared_bands) {
      const Level before = band_level(all.front(), channel, band);
      if (!std::isfinite(before.value))
        continue;
      rows += "<tr><th scope=\"row\">" + escaped(channel) + "</th><td>" + band.name + "</td>";
      for (const ComparedAnalysis &one : all)
        rows += "<td class=\"num\">" + significant(1e3 * band_velocity(one, channel, band), 3) + "</td>";
      rows += "<td class=\"num\"><b>" + change_text(before, band_level(all.back(), channel, band)) +
              "</b></td></tr>\n";
    }
  return rows.empty() ? ""
                      : "<table class=\"results\"><thead><tr>" + head +
                            "<th>change, 95 %</th></tr></thead>\n<tbody>\n" + rows + "</tbody></table>\n";
}

bool is_line(const json &finding)
{
  const auto kind = kind_of(finding);
  return kind == FindingKind::line || kind == FindingKind::family;
}

bool is_compared(const json &finding)
{
  const auto kind = kind_of(finding);
  return (kind == FindingKind::mode || kind == FindingKind::resonance || is_line(finding)) &&
         std::isfinite(number_in(finding["frequency"]));
}

double half_interval(const json &finding)
{
  const double half = 0.5 * (number_in(finding["interval"][1]) - number_in(finding["interval"][0]));
  return std::isfinite(half) ? half : 0;
}

// The finding of the same kind of peak that is nearest, within both intervals or 2 %.
const json *partner_of(const json &finding, const json &others)
{
  const double f      = number_in(finding["frequency"]);
  const json *nearest = nullptr;
  for (const json &other : others) {
    if (!is_compared(other) || is_line(finding) != is_line(other))
      continue;
    const double away = std::abs(number_in(other["frequency"]) - f);
    if (away <= std::max(half_interval(finding) + half_interval(other), 0.02 * f) &&
        (!nearest || away < std::abs(number_in((*nearest)["frequency"]) - f)))
      nearest = &other;
  }
  return nearest;
}

std::string peak_table(const ComparedAnalysis &before, const ComparedAnalysis &after)
{
  std::string rows;
  const auto row = [&](const json *a, const json *b) {
    const json &shown = a ? *a : *b;
    const auto value  = [](const json *one) {
      return one ? fixed(number_in((*one)["frequency"]), 2) + " Hz, " +
                       significant(number_in((*one)["amplitude"]), 3) + " " +
                       escaped(unit_sign((*one)["unit"].get<std::string>()))
                  : std::string("\u2013");
    };
    std::string change = a ? "gone" : "new";
    if (a && b) {
      const double moved  = number_in((*b)["frequency"]) - number_in((*a)["frequency"]);
      const double within = std::hypot(half_interval(*a), half_interval(*b));
      change              = (moved >= 0 ? "+" : "\u2212") + significant(std::abs(moved), 2) + " Hz \u00b1 " +
               significant(within, 1) + (std::abs(moved) > within ? "" : " (not significant)") + "; amplitude " +
               ((*a)["channel"] == (*b)["channel"] ? change_text(amplitude_of(*a), amplitude_of(*b))
                                                   : std::string("of another channel"));
    }
    rows += "<tr><th scope=\"row\">" + escaped(shown["kind"].get<std::string>()) + "</th><td>" +
            escaped(shown["channel"].get<std::string>()) + "</td><td class=\"num\">" + value(a) +
            "</td><td class=\"num\">" + value(b) + "</td><td>" + change + "</td></tr>\n";
  };
  for (const json &finding : before.document["findings"])
    if (is_compared(finding))
      row(&finding, partner_of(finding, after.document["findings"]));
  for (const json &finding : after.document["findings"])
    if (is_compared(finding) && !partner_of(finding, before.document["findings"]))
      row(nullptr, &finding);
  return rows.empty() ? ""
                      : "<table class=\"results\"><thead><tr><th>kind</th><th>channel</th><th>" +
                            escaped(before.folder) + "</th><th>" + escaped(after.folder) +
                            "</th><th>change, 95 %</th></tr></thead>\n<tbody>\n" + rows + "</tbody></table>\n";
}

std::string spectra_drawing(const std::vector<ComparedAnalysis> &all, const std::string &channel)
{
  Plot plot;
  plot.title  = channel;
  plot.width  = 1000;
  plot.height = 330;
  plot.x      = {"frequency", "Hz", Scale::logarithmic};
  plot.y      = {"density", "(" + unit_sign(unit_of_channel(all.front(), channel)) + ")²/Hz", Scale::logarithmic};
  double most = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Eigen::VectorXd &x = all[i].spectrum->columns[0], &y = *density_of(all[i], channel);
    plot.lines.push_back({all[i].folder, x.tail(x.size() - 1), y.tail(y.size() - 1), pens[i % pens.size()]});
    most = std::max(most, y.maxCoeff());
  }
  plot.x.low  = 1;
  plot.y.low  = 1e-12 * most;
  plot.y.high = 2 * most;
  return most > 0 ? svg_plot(plot) : "";
}
}  // namespace

std::string analysis_comparison(const std::vector<std::string> &directories)
{
  std::vector<ComparedAnalysis> all;
  for (const std::string &directory : directories)
    all.push_back(read_analysis(directory));
  const std::vector<std::string> channels = shared_channels(all);
  if (channels.empty())
    throw InputError("the analyses of " + directories.front() + " and " + directories.back() +
                     " have no channel of the same name; give --channel NAME=PLACE when they are analysed");
  const Run run = run_of(directories.back(), all.back().document);
  Page page(run);
  page.section("levels", "Levels", Depth::manager);
  page.table(
      band_table(all, channels),
      "Root mean square of the velocity in bands. The change is that from the first to the last analysis, "
      "with the 95 % interval that the variation of the level over both records gives. A change within it is "
      "not significant.");
  page.section("peaks", "Modes and lines", Depth::manager);
  for (std::size_t i = 1; i < all.size(); ++i)
    page.table(peak_table(all.front(), all[i]), "Frequency and amplitude (0-peak) of each mode, resonance, line "
                                                "and family. A change of the frequency or of "
                                                "the amplitude within both 95 % intervals is not significant.");
  page.section("spectra", "Spectra");
  for (const std::string &channel : channels)
    page.figure({spectra_drawing(all, channel)},
                "One-sided density of " + escaped(channel) + " in every analysis.");
  const std::string head = "<header><h1>Analyses compared</h1></header>\n<div class=\"verdict ok\"><p>" +
                           first_sentence(all, channels) + ".</p></div>\n";
  return html_document(run.case_name + ", compared", run, page, head);
}
}  // namespace mill::report
