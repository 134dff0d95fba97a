#include "core/records/result_names.h"
#include "report/nonlinear/data.h"
#include "report/page/cells.h"
#include "report/page/curves.h"
#include "report/page/page.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include "report/results/tables.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
constexpr double bend_of_note = 0.001;  // of a frequency, from which a backbone is drawn
constexpr double ten_digits   = 1e-10;

std::string table_head(const std::vector<std::string> &columns)
{
  std::string row;
  for (const std::string &column : columns)
    row += "<th>" + column + "</th>";
  return "<table><thead><tr>" + row + "</tr></thead>\n<tbody>\n";
}

std::string title_of(const NonlinearMode &mode)
{
  return mode.name.empty() ? "mode " + std::to_string(mode.number) : mode.name;
}

std::string rolls_table(const NonlinearData &data)
{
  std::string rows;
  for (const NonlinearRoll &roll : data.rolls)
    for (const bool peak : {true, false}) {
      const double curve = peak ? roll.peak : roll.rms, linear = peak ? roll.linear_peak : roll.linear_rms;
      rows += "<tr><th scope=\"row\">" + escaped(roll.name) + (peak ? ", peak" : ", rms") + "</th>" +
              cell("<b>" + g_text(curve / standard_gravity) + "</b>") + cell(g_text(linear / standard_gravity)) +
              cell(percent(curve / linear - 1)) +
              cell(percent((peak ? roll.fixed_peak : roll.fixed_rms) / curve - 1)) + "</tr>\n";
    }
  return table_head({"", "on curves [g]", "linear [g]", "curves over linear", "fixed steps over adaptive"}) +
         rows + "</tbody></table>\n";
}

std::string springs_table(const NonlinearData &data)
{
  std::string rows;
  for (const NonlinearSpring &s : data.springs)
    rows += "<tr><th scope=\"row\">" + escaped(s.name) + "</th>" + cell(significant(s.rest / 1e3, 4)) +
            cell(significant(s.stiffness / 1e6, 4)) + cell(percent(s.corrected)) + cell(percent(s.smoothed)) +
            cell("<b>" + fixed(100 * s.least, 1) + " %</b>") + cell(fixed(s.least_at, 4)) +
            cell(fixed(100 * s.largest, 1) + " %") + cell(s.parted > 0 ? std::to_string(s.parted) : "never") +
            "</tr>\n";
  return table_head({"spring", "at rest [kN]", "slope there [kN/mm]", "slope over that of the curve",
                     "curve off samples", "smallest force", "at [s]", "largest force", "parts"}) +
         rows + "</tbody></table>\n";
}

std::string harmonics_of(const NonlinearMode &mode)
{
  if (mode.harmonics.size() < 3 || !(mode.harmonics[0] > 0))
    return cell("\u2013") + cell("\u2013") + cell("\u2013");
  std::string cells = cell(g_text(mode.harmonics[0] / standard_gravity));
  for (const std::size_t h : {std::size_t(1), std::size_t(2)}) {
    const double share = mode.harmonics[h] / mode.harmonics[0];
    cells += cell(share < ten_digits ? "0" : significant(100 * share, 2) + " %");
  }
  return cells;
}

std::string modes_table(const NonlinearData &data)
{
  std::string rows;
  for (const NonlinearMode &mode : data.modes) {
    rows += "<tr><th scope=\"row\">" + escaped(title_of(mode)) + "</th>" + cell(fixed(mode.frequency, 1)) +
            "<td>" + escaped(mode.opens) + "</td>" + cell(significant(mode.parting_amplitude * 1e6, 3)) + "<td>" +
            escaped(mode.mover) + "</td>" + cell("<b>" + percent(mode.bend) + "</b>") +
            cell(percent(mode.bend_in_run)) + cell(significant(mode.parting_force / 1e3, 3)) + harmonics_of(mode) +
            "</tr>\n";
  }
  return table_head({"mode", "[Hz]", "parts first", "at [\u00b5m]", "of", "frequency there", "in this run",
                     "parting force [kN]", "at f [g]", "2f", "3f"}) +
         rows + "</tbody></table>\n";
}

std::string backbones(const NonlinearData &data)
{
  Plot plot;
  plot.title        = "Frequency over amplitude, as far as a contact parts and beyond";
  plot.width        = 1040;
  plot.height       = 360;
  plot.x            = {"amplitude over that at which a contact parts", "-", Scale::linear, 0, 1.5};
  plot.y            = {"frequency over that of small motion, less 1", "%"};
  const Pen pens[]  = {Pen::dark, Pen::warm,        Pen::dashed,      Pen::dotted,     Pen::chained,
                       Pen::pale, Pen::warm_dashed, Pen::dark_dashed, Pen::pale_dashed};
  std::size_t drawn = 0;
  for (const NonlinearMode &mode : data.modes) {
    if (!(std::abs(mode.bend) > bend_of_note) || mode.amplitude.empty())
      continue;
    Line line;
    line.label = title_of(mode) + ", " + fixed(mode.frequency, 1) + " Hz";
    line.x     = Eigen::Map<const Eigen::VectorXd>(mode.amplitude.data(), Eigen::Index(mode.amplitude.size())) /
             mode.parting_amplitude;
    line.y = 100 *
             (Eigen::Map<const Eigen::VectorXd>(mode.followed.data(), line.x.size()).array() / mode.frequency - 1);
    line.pen = pens[drawn++ % std::size(pens)];
    plot.lines.push_back(std::move(line));
  }
  if (drawn == 0)
    return "";
  plot.marks.push_back({1, "a contact parts"});
  return svg_plot(plot);
}

std::string spectra(const Table &table, const char *roll, const std::string &title)
{
  Plot plot;
  plot.title  = title;
  plot.width  = 510;
  plot.height = 340;
  plot.x      = {"frequency", "Hz", Scale::logarithmic};
  plot.y      = {"acceleration", "g/sqrt(Hz)", Scale::logarithmic};
  add_line(plot, table, {"frequency", "Hz"}, {std::string(roll) + "_linear", "g/sqrt(Hz)"}, "linear", Pen::warm);
  add_line(plot, table, {"frequency", "Hz"}, {roll, "g/sqrt(Hz)"}, "on curves", Pen::dark);
  plot.y.unit = "g/\u221aHz";
  return svg_plot(plot);
}

std::string scale_sentence(const NonlinearData &data)
{
  if (std::isnan(data.scale_to_part))
    return " No multiple of this record that keeps the rolls together parts a contact.";
  return " The first contact parts when the fluctuation of the record is <b>" +
         significant(data.scale_to_part, 3) + "</b> times as large.";
}

void pass_part(Page &page, const Run &run, const PassInfo &pass, const NonlinearData &data)
{
  page.heading(pass.name);
  page.paragraph("<b>" + escaped(data.verdict) + "</b>" + scale_sentence(data) + " Model: " + escaped(data.model) +
                 ", springs at rest under " + significant(data.load / 1e3, 4) + " kN.");
  page.table(rolls_table(data),
             "Levels on the curves of the contacts compared with the linear run. The adaptive run limits the "
             "error of every step to 1e-10 of the motion; energy that is missing at its end: " +
                 significant(std::abs(data.balance), 2) + " of the work of the force.");
  page.table(
      springs_table(data),
      "Springs that follow curves, forces over those at rest. A linear spring in series gives each curve the "
      "slope of the linear model at its load; contacts are smoothed by the form of a line contact, since the "
      "nodes of a mesh step the slope of the samples.");
  if (const Table *table = stored_curve(run, curve::nonlinear_spectrum, pass.slug))
    page.figure(
        {spectra(*table, "upper_work_roll", "Upper work roll"),
         spectra(*table, "lower_work_roll", "Lower work roll")},
        "Spectra on the curves and on their slopes. Where the lines part, the stand answers at frequencies that "
        "the force does not have.");
  if (const std::string drawing = backbones(data); !drawing.empty())
    page.figure({drawing},
                "Backbone curves of the modes whose frequency moves by more than 0.1 % until a contact parts, "
                "free and undamped (harmonic balance). Points: <code>curves/backbone-" +
                    escaped(pass.slug) + ".csv</code>.");
  if (!data.modes.empty())
    page.table(
        modes_table(data),
        "Modes over their amplitude, and their answer to a harmonic force in the bite. The parting force is the "
        "amplitude at the mode's frequency from which a contact parts in every period; f, 2f and 3f are "
        "accelerations of the work roll that moves most under " +
            significant(data.force_range / 2e3, 3) + " kN, half of the record's range.");
  for (const Warning &note : data.notes)
    page.paragraph(escaped(text_of(note)) + ".");
}
}  // namespace

void nonlinear_section(Page &page, const Run &run)
{
  bool begun = false;
  for (const PassInfo &pass : run.manifest.passes) {
    const NonlinearData data = read_nonlinear(run.directory, pass.slug);
    if (!data.stored && data.problem.empty())
      continue;
    if (!begun)
      page.section("contact-curves", "Contacts and bearings on their curves");
    begun = true;
    if (data.problem.empty())
      pass_part(page, run, pass, data);
    else
      page.html("<p class=\"absent\">" + escaped(data.problem) + "</p>");
  }
}
}  // namespace mill::report
