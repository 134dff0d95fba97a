#include "report/curves.h"
#include "report/names.h"
#include "report/number.h"
#include "report/sections.h"
#include "report/svg.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
struct WorkingLoad {
  std::string name;
  double load;  // N, total over the contact length
};

// Loads of the passes; for two cylinders the load at which the scalar results stand.
std::vector<WorkingLoad> working_loads(const Run &run, const std::string &contact)
{
  std::vector<WorkingLoad> loads;
  for (const PassInfo &pass : run.manifest.passes)
    if (std::isfinite(pass.load))
      loads.push_back({pass.name, pass.load});
  if (!loads.empty())
    return loads;
  for (const Result &result : run.results)
    if (result.name.rfind("contact." + contact + ".", 0) == 0 && !result.at.empty()) {
      const double load = load_in_text(result.at);
      if (std::isfinite(load))
        return {
            {result.at, load}
        };
    }
  return {};
}

struct ClosedForm {
  const char *column, *label;
  Pen beside_curve;   // where it stands beside one computed curve
  Pen beside_slopes;  // where tangent and secant are drawn together
};
const ClosedForm closed_secants[] = {
    {"hertz_secant",      "Hertz, axis to axis",            Pen::warm,    Pen::warm_dashed},
    {"foeppl_secant",     "F\u00f6ppl, parabolic pressure", Pen::dashed,  Pen::pale       },
    {"half_space_secant", "larger roll as half space",      Pen::dotted,  Pen::dotted     },
    {"palmgren_secant",   "Palmgren, empirical",            Pen::chained, Pen::chained    },
};

void mark_loads(Plot &plot, const std::vector<WorkingLoad> &loads)
{
  for (const WorkingLoad &load : loads)
    plot.marks.push_back({load.load * 1e-3, load.name});
}

std::string load_approach(const Table &curve, const Table *closed, const std::vector<WorkingLoad> &loads)
{
  Plot plot;
  plot.title = "Load over approach";
  plot.x     = {"approach of the roll axes", "\u00b5m"};
  plot.y     = {"load on the contact", "kN"};
  plot.x.low = plot.y.low = 0;
  add_line(plot, curve, {"approach", "\u00b5m"}, {"load", "kN"}, "this run", Pen::dark, true);
  if (closed)
    for (const ClosedForm &form : closed_secants) {
      const Eigen::VectorXd load   = values_of(*closed, {"load", "N"});
      const Eigen::VectorXd secant = values_of(*closed, {form.column, "N/m"});
      if (load.size() > 0 && secant.size() == load.size())
        plot.lines.push_back({form.label, 1e6 * load.cwiseQuotient(secant), 1e-3 * load, form.beside_curve});
    }
  const Eigen::VectorXd load     = values_of(curve, {"load", "N"}),
                        approach = values_of(curve, {"approach", "\u00b5m"});
  for (const WorkingLoad &working : loads)
    plot.points.push_back({interpolated(load, approach, working.load), working.load * 1e-3, working.name});
  return svg_plot(plot);
}

std::string stiffness_over_load(const Table &curve, const Table *closed, const std::vector<WorkingLoad> &loads)
{
  Plot plot;
  plot.title = "Stiffness over load";
  plot.x     = {"load on the contact", "kN", Scale::logarithmic};
  plot.y     = {"stiffness", "kN/mm"};
  add_line(plot, curve, {"load", "kN"}, {"tangent", "kN/mm"}, "tangent, this run", Pen::dark, true);
  if (closed)
    add_line(plot, *closed, {"load", "kN"}, {"hertz_tangent", "kN/mm"}, "tangent, Hertz", Pen::warm);
  add_line(plot, curve, {"load", "kN"}, {"secant", "kN/mm"}, "secant, this run", Pen::dashed, true);
  if (closed)
    for (const ClosedForm &form : closed_secants)
      add_line(plot, *closed, {"load", "kN"}, {form.column, "kN/mm"}, std::string("secant, ") + form.label,
               form.beside_slopes);
  mark_loads(plot, loads);
  return svg_plot(plot);
}

std::string along_barrel(const Table &barrel, const char *column, const char *quantity, const char *unit)
{
  Plot plot;
  plot.title  = quantity;
  plot.width  = 333;
  plot.height = 260;
  plot.x      = {"distance from mid-length", "mm"};
  plot.y      = {quantity, unit};
  plot.y.low  = 0;
  add_line(plot, barrel, {"z", "mm"}, {column, unit}, "", Pen::dark, true);
  return svg_plot(plot);
}

// A stiffness of the table at one load.  The compliance of a line contact is a straight line over ln(load), so it
// is the compliance that is interpolated.
double stiffness_at(const Table &table, const char *column, const double load)
{
  return 1 / interpolated(values_of(table, {"load", "N"}), values_of(table, {column, "N/m"}).cwiseInverse(), load);
}

// Where the computed secant stands among the four closed forms, load by load.
struct Band {
  double secant, lowest, highest;  // N/m
};

Band band_at(const Table &curve, const Table &closed, const double load)
{
  Band band{stiffness_at(curve, "secant", load), std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};
  for (const ClosedForm &form : closed_secants) {
    const double value = stiffness_at(closed, form.column, load);
    if (std::isfinite(value)) {
      band.lowest  = std::min(band.lowest, value);
      band.highest = std::max(band.highest, value);
    }
  }
  return band;
}

std::string place_in(const Band &band)
{
  if (band.secant < band.lowest)
    return percent(band.secant / band.lowest - 1) + " from the lowest: below the band";
  if (band.secant > band.highest)
    return percent(band.secant / band.highest - 1) + " from the highest: above the band";
  return fixed(100 * (band.secant - band.lowest) / (band.highest - band.lowest), 0) +
         "\u00a0% of the way from the lowest to the highest";
}

std::string band_table(const Table &curve, const Table &closed, const std::vector<WorkingLoad> &loads)
{
  std::string rows;
  for (const WorkingLoad &working : loads) {
    const Band band = band_at(curve, closed, working.load);
    if (!std::isfinite(band.secant) || !(band.lowest <= band.highest))
      continue;
    const double tangent = stiffness_at(curve, "tangent", working.load);
    const double hertz   = stiffness_at(closed, "hertz_tangent", working.load);
    rows += "<tr><th scope=\"row\">" + escaped(working.name) + "</th><td class=\"num\">" +
            significant(working.load * 1e-3, 4) + "</td><td class=\"num\">" + significant(tangent * 1e-6, 5) +
            "</td><td class=\"num\">" + significant(hertz * 1e-6, 5) + " (" + percent(tangent / hertz - 1) +
            ")</td><td class=\"num\">" + significant(band.secant * 1e-6, 5) + "</td><td class=\"num\">" +
            significant(band.lowest * 1e-6, 5) + " \u2026 " + significant(band.highest * 1e-6, 5) + "</td><td>" +
            place_in(band) + "</td></tr>\n";
  }
  if (rows.empty())
    return "";
  return "<table><thead><tr><th>at</th><th>load [kN]</th><th>tangent [kN/mm]</th><th>Hertz tangent [kN/mm] (run "
         "deviates by)</th>"
         "<th>secant [kN/mm]</th><th>closed forms, secant [kN/mm]</th><th>this run in the "
         "band</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n";
}

std::string band_caption(const bool plane_strain)
{
  return std::string(
             "The computed stiffness among the closed forms of a line contact. The forms differ in the pressure "
             "they assume and in the body that carries it; the half space replaces the larger roll by a body "
             "without a far side. ") +
         (plane_strain
              ? "The cylinders of this case are long, as Hertz assumes: his form, axis to axis, is the one to "
                "be met."
              : "None of them is exact here: all leave out that a barrel has an end and a neck, where load "
                "and stiffness per length change.");
}

void one_contact(Page &page, const Run &run, const std::string &name)
{
  const std::string path = "curves/contact-" + name;
  const Table &curve     = *run.table(path);
  const Table *closed    = run.table(path + "-closed");
  const auto loads       = working_loads(run, name);
  std::string title      = contact_title(name);
  title[0]               = char(std::toupper(static_cast<unsigned char>(title[0])));
  page.heading(title);
  page.figure(
      {load_approach(curve, closed, loads), stiffness_over_load(curve, closed, loads)},
      "Left: how far the two roll axes come together under the load; the dots are the solved loads, the "
      "circles the working loads. Right: the two slopes of that curve. The <b>tangent</b> is what a vibrating "
      "mill feels, the <b>secant</b> what screwing down feels; both grow only with the logarithm of the load.");
  if (!closed)
    page.absent("Closed forms beside the contact curve are", path + "-closed.csv");
  else if (const std::string table = band_table(curve, *closed, loads); !table.empty())
    page.table(table, band_caption(name == "line"));
  if (const Table *barrel = run.table(path + "-barrel"))
    page.figure(
        {along_barrel(*barrel, "line_load", "line load q", "kN/mm"),
         along_barrel(*barrel, "tangent", "tangent per length k", "kN/mm per m"),
         along_barrel(*barrel, "peak_pressure", "peak pressure p\u2080", "MPa")},
        "Along the barrel, from mid-length to its end: load per length, stiffness per length and largest "
        "pressure. A flat line is what a plane-strain formula assumes; what it does towards the right is the "
        "effect of the barrel end and of the crown.");
  else if (name != "line")
    page.absent("The distribution along the barrel is", path + "-barrel.csv");
}

void bite(Page &page, const Table &table)
{
  Plot pressure;
  pressure.title = "Pressure in the bite";
  pressure.x     = {"distance along the arc of contact", "mm"};
  pressure.y     = {"roll pressure", "MPa"};
  add_line(pressure, table, {"x", "mm"}, {"pressure", "MPa"}, "", Pen::dark);
  Plot thickness;
  thickness.title = "Strip thickness";
  thickness.x     = pressure.x;
  thickness.y     = {"thickness", "mm"};
  add_line(thickness, table, {"x", "mm"}, {"thickness", "mm"}, "", Pen::dark);
  page.heading("Bite (K4)");
  page.figure({svg_plot(pressure), svg_plot(thickness)},
              "Slab model of the bite: roll pressure with its friction hill, and the strip between the rolls. "
              "The plastic slope of K4 follows from how the force changes with the exit gap.");
}
}  // namespace

void contact_section(Page &page, const Run &run)
{
  const auto contacts = names_of_curves(run, "contact", {"closed", "barrel"});
  if (contacts.empty() && run.manifest.kind == "lumped")
    return;
  page.section("contact", "Roll contact");
  if (contacts.empty())
    page.absent("Contact figures are", "curves/contact-*.csv");
  for (const std::string &name : contacts)
    one_contact(page, run, name);
  if (const Table *table = run.table("curves/bite"))
    bite(page, *table);
}
}  // namespace mill::report
