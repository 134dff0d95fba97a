#include "core/model/dynamics_settings.h"
#include "core/records/rows_of_response.h"
#include "report/page/curves.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/names.h"
#include "report/results/tables.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
// What made the responses, by the source of their peaks.
StandModelKind driven_model(const Run &run)
{
  const auto peak = std::find_if(run.results.begin(), run.results.end(), [](const Result &result) {
    return is_made_by(row::response::peak, result.name);
  });
  for (const auto &[model, source] : {std::pair(StandModelKind::beam, "rolls as beams"),
                                      std::pair(StandModelKind::craig_bampton, "reduced finite elements")})
    if (peak != run.results.end() && peak->source.find(source) != std::string::npos)
      return model;
  return StandModelKind::six_mass;
}

std::string driven_title(const Run &run)
{
  switch (driven_model(run)) {
  case StandModelKind::six_mass:
    break;
  case StandModelKind::beam:
    return "stand of beams";
  case StandModelKind::craig_bampton:
    return "stand of reduced finite elements";
  }
  return "chain of six masses";
}

struct Channel {
  const char *column, *title, *quantity, *unit;
  bool of_roll;  // an acceleration, on the scale of both rolls
};
const Channel channels[] = {
    {"force", "Rolling force", "force", "kN", false},
    {"load_cell", "Load cell", "force", "kN", false},
    {"upper_work_roll", "Upper work roll", "acceleration", "g", true},
    {"lower_work_roll", "Lower work roll", "acceleration", "g", true},
};

// Both rolls on one scale: the difference between them is what one looks for.
double largest_acceleration(const Table &table)
{
  double largest = 0;
  for (const char *roll : {"upper_work_roll", "lower_work_roll"}) {
    const Eigen::VectorXd a = values_of(table, {roll, "g"});
    if (a.size() > 0)
      largest = std::max(largest, a.cwiseAbs().maxCoeff());
  }
  return largest;
}

std::string history(const Table &table, const Channel &channel, const std::string &title, const double limit)
{
  Plot plot;
  plot.title  = title;
  plot.width  = page_width;
  plot.height = 190;
  plot.x      = {"time", "s"};
  plot.y      = {channel.quantity, channel.unit};
  if (channel.of_roll && limit > 0) {
    plot.y.low  = -limit;
    plot.y.high = limit;
  }
  add_line(plot, table, {"time", "s"}, {channel.column, channel.unit}, "", Pen::dark);
  return svg_plot(plot);
}

// The static drawing for paper, and for the screen the data of a chart that page.js puts in its place.
std::string zoomable(const std::string &drawing, const PassInfo &pass, const Table &table, const Channel &channel,
                     const double limit)
{
  const Eigen::VectorXd time  = values_of(table, {"time", "s"});
  const Eigen::VectorXd value = values_of(table, {channel.column, channel.unit});
  return "<div class=\"history\"><div class=\"static\">" + drawing + "</div>" +
         zoom_chart(pass.slug, std::string(channel.quantity) + " [" + channel.unit + "]",
                    channel.of_roll ? limit : 0, time, {{channel.title, value}}) +
         "</div>\n";
}

void histories(Page &page, const Run &run, const PassInfo &pass, const Table &table)
{
  const Table *measured = run.table("response/" + pass.slug + "-measured");
  const double limit =
      1.05 * std::max(largest_acceleration(table), measured ? largest_acceleration(*measured) : 0.0);
  std::string drawings;
  for (const Channel &channel : channels)
    if (values_of(table, {channel.column, channel.unit}).size() > 0)
      drawings += zoomable(history(table, channel, channel.title, limit), pass, table, channel, limit);
  if (measured)
    for (const Channel &channel : channels)
      if (values_of(*measured, {channel.column, channel.unit}).size() > 0)
        drawings += history(*measured, channel, std::string(channel.title) + ", measured", limit);
  page.figure(
      {"<div class=\"histories\">\n" + drawings + "</div>\n"},
      "Histories of " + escaped(pass.name) +
          (pass.synthetic ? ", driven by a <b>synthetic</b> force record (generated, not measured)" : "") +
          ". Every drawn column keeps its smallest and largest sample, so no peak is lost; the samples "
          "themselves are in <code>response/" +
          escaped(pass.slug) + ".csv</code>." +
          (measured ? " The measured accelerations stand below on the same scale." : "") +
          "<span class=\"zoom-hint\"> Drag to zoom all charts of this pass, shift and drag to move, double "
          "click to see all.</span>");
}

std::string around_the_peak(const Table &table)
{
  const Eigen::VectorXd time = values_of(table, {"time", "s"}), upper = values_of(table, {"upper_work_roll", "g"});
  if (upper.size() < 2 || time.size() != upper.size())
    return "";
  Eigen::Index peak = 0;
  upper.cwiseAbs().maxCoeff(&peak);
  Plot plot;
  plot.title  = "Around the largest acceleration of the upper work roll";
  plot.width  = page_width;
  plot.height = 250;
  plot.x      = {"time", "s", Scale::linear, std::max(time[0], time[peak] - 0.025),
                 std::min(time[time.size() - 1], time[peak] + 0.025)};
  plot.y      = {"acceleration", "g"};
  add_line(plot, table, {"time", "s"}, {"upper_work_roll", "g"}, "upper work roll", Pen::dark);
  add_line(plot, table, {"time", "s"}, {"lower_work_roll", "g"}, "lower work roll", Pen::warm);
  plot.points.push_back({time[peak], upper[peak], g_text(upper[peak]) + " g"});
  for (Line &line : plot.lines) {  // only the samples of the window: the rest would be cut away anyway
    const auto first = std::lower_bound(line.x.begin(), line.x.end(), plot.x.low) - line.x.begin();
    const auto end   = std::upper_bound(line.x.begin(), line.x.end(), plot.x.high) - line.x.begin();
    line.x           = line.x.segment(first, end - first).eval();
    line.y           = line.y.segment(first, end - first).eval();
  }
  return svg_plot(plot);
}

std::string spectrum(const Run &run, const Table &table, const std::string &title,
                     const std::vector<std::pair<std::string, std::string>> &columns, const std::string &quantity,
                     const std::string &unit)
{
  Plot plot;
  plot.title  = title;
  plot.height = 360;
  plot.width  = 510;
  plot.x      = {"frequency", "Hz", Scale::logarithmic};
  plot.y      = {quantity, unit, Scale::logarithmic};
  Pen pen     = Pen::dark;
  for (const auto &[column, label] : columns) {
    add_line(plot, table, {"frequency", "Hz"}, {column, unit}, label, pen);
    pen = Pen::warm;
  }
  double largest = 0;
  for (const Line &line : plot.lines)
    largest = std::max(largest, line.y.maxCoeff());
  if (largest > 0) {  // four decades below the largest value is noise of the record
    plot.y.low  = 1e-4 * largest;
    plot.y.high = 2 * largest;
  }
  plot.x.low              = 5;  // below, a record of some seconds has no resolution worth showing
  const bool of_chain     = driven_model(run) == StandModelKind::six_mass;
  const std::string model = of_chain ? "" : word_of(driven_model(run));
  for (int i = 1; const Result *f = run.find(result_name({model, "f" + std::to_string(i)})); ++i) {
    plot.marks.push_back({f->value, "f" + std::to_string(i)});
    plot.x.high = (of_chain ? 4 : 2) * f->value;  // further up there is nothing to answer with
  }
  return svg_plot(plot);
}

void one_pass(Page &page, const Run &run, const PassInfo &pass)
{
  page.heading("Response, " + pass.name + (pass.synthetic ? " (synthetic force record)" : ""));
  const std::string path = "response/" + pass.slug;
  const Table *table = run.table(path), *spectra = run.table(path + "-spectrum");
  if (table) {
    histories(page, run, pass, *table);
    if (const std::string peak = around_the_peak(*table); !peak.empty())
      page.figure({peak}, "Fifty milliseconds of " + escaped(pass.name) +
                              " around its largest acceleration, every sample drawn: the rolls ring at their own "
                              "frequencies, the force only feeds them.");
  } else
    page.absent("Histories of " + pass.name + " are", path + ".csv");
  if (spectra)
    page.figure({spectrum(run, *spectra, "Rolling force", {{"force", ""}}, "amplitude density", "N/\u221aHz"),
                 spectrum(run, *spectra, "Accelerations",
                          {{"upper_work_roll", "upper work roll"}, {"lower_work_roll", "lower work roll"}},
                          "amplitude density", "g/\u221aHz")},
                "Spectra of " + escaped(pass.name) + " with the natural frequencies of " +
                    (driven_model(run) == StandModelKind::six_mass ? "the chain" : "the " + driven_title(run)) +
                    " marked, up to " + (driven_model(run) == StandModelKind::six_mass ? "four times" : "twice") +
                    " the highest. A peak of the "
                    "acceleration at a mark where the "
                    "force has none is a resonance of the stand; where the force spectrum ends, so does what this "
                    "record can say.");
  else
    page.absent("Spectra of " + pass.name + " are", path + "-spectrum.csv");
}

std::string force_rows(const Run &run)
{
  std::string rows;
  for (const PassInfo &pass : run.manifest.passes) {
    const Table *table = run.table("response/" + pass.slug);
    if (!table)
      continue;
    const Eigen::VectorXd time = values_of(*table, {"time", "s"}), force = values_of(*table, {"force", "kN"});
    if (force.size() < 2 || time.size() != force.size())
      continue;
    const double duration = time[time.size() - 1] - time[0];
    rows += "<tr><th scope=\"row\">" + escaped(pass.name) + "</th><td>" +
            (pass.synthetic ? "synthetic" : "recorded") + "</td><td>" +
            (pass.force_meaning ? word_of(*pass.force_meaning) : "") + "</td><td class=\"num\">" +
            fixed(force.mean(), 1) + "</td><td class=\"num\">" + fixed(force.minCoeff(), 2) + " \u2026 " +
            fixed(force.maxCoeff(), 2) + "</td><td class=\"num\">" +
            fixed(force.maxCoeff() - force.minCoeff(), 3) + "</td><td class=\"num\">" + fixed(duration, 2) +
            "</td><td class=\"num\">" + fixed(1e-3 * double(time.size() - 1) / duration, 1) + "</td></tr>\n";
  }
  return rows;
}

void what_the_levels_say(Page &page, const Run &run)
{
  page.paragraph("<b>Identifiable.</b> A broadband force excites the chain to a level proportional to "
                 "<span class=\"together\">(damping \u00d7 bandwidth)<sup>\u22121/2</sup></span>, so measured "
                 "levels determine only the product of damping ratio and force "
                 "bandwidth. A linear model scales with its force: one normalised history gives two passes "
                 "accelerations in the "
                 "ratio of their force ranges, whatever the stiffnesses, the spectrum and the damping.");
  page.paragraph("<b>Assumed.</b> The spectrum of the rolling force and the damping of the modes. Agreement with "
                 "measured peaks "
                 "supports the pair, neither of the two alone, and a peak of a random record scatters from record "
                 "to record.");
  std::string synthetic;
  for (const PassInfo &pass : run.manifest.passes)
    if (pass.synthetic)
      synthetic += (synthetic.empty() ? "" : ", ") + escaped(pass.name);
  if (!synthetic.empty())
    page.paragraph("<b>Synthetic.</b> Generated inside a stated range and never measured is the force of: " +
                   synthetic + ". Its peaks show what the model makes of such a force, not what a mill did.");
}
}  // namespace

void response_section(Page &page, const Run &run)
{
  if (!has_chain(run))
    return;
  page.section("response", "Response to the rolling force");
  if (run.manifest.passes.empty())
    page.paragraph("No pass was simulated in this run.");
  if (const std::string table = peak_table(run); !table.empty()) {
    page.table(table, "Largest accelerations of the work rolls at mid-length, computed with the " +
                          driven_title(run) + ". Peaks are zero to peak.");
    what_the_levels_say(page, run);
  }
  if (const std::string rows = force_rows(run); !rows.empty())
    page.table(
        "<table><thead><tr><th>pass</th><th>record</th><th>read as</th><th>mean [kN]</th><th>range [kN]</th>"
        "<th>peak to peak [kN]</th><th>duration [s]</th><th>output rate [kHz]</th></tr></thead>\n<tbody>\n" +
            rows + "</tbody></table>\n",
        "The driving forces. Read as \u201cmeasured\u201d, a record is the total force in the bite and K4 "
        "does not act; as \u201cdisturbance\u201d, it is the part that does not come from the moving gap.");
  for (const PassInfo &pass : run.manifest.passes)
    one_pass(page, run, pass);
}
}  // namespace mill::report
