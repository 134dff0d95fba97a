#include "report/contact/curves.h"
#include "core/records/contact_name.h"
#include "core/records/open_rows.h"
#include "core/records/rows_of_contact.h"
#include "report/page/curves.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::report {
const std::array<ClosedForm, 4> closed_secants{{
    {"hertz_secant", "Hertz, axis to axis", Pen::warm, Pen::warm_dashed},
    {"foeppl_secant", "F\u00f6ppl, parabolic pressure", Pen::dashed, Pen::pale},
    {"half_space_secant", "larger roll as half space", Pen::dotted, Pen::dotted},
    {"palmgren_secant", "Palmgren, empirical", Pen::chained, Pen::chained},
}};

namespace {
constexpr double not_stored = std::numeric_limits<double>::quiet_NaN();

bool is_of_contact(const std::string &name, const std::string &contact)
{
  const auto id = result_id_or_open(name);
  if (!id)
    return false;
  if (id->is_of(row::space::all))
    return is_contact(contact, ContactName::space);
  if (id->is_of(row::line::all))
    return is_contact(contact, ContactName::line);
  return (id->is_of(row::contact::all) && contact == id->place("contact")) ||
         (id->is_of(row::open::contact) && contact == id->place("rolls"));
}

// Loads of the passes; for two cylinders the load at which the scalar results stand.
std::vector<WorkingLoad> working_loads(const Run &run, const std::string &contact, const std::string &unit)
{
  std::vector<WorkingLoad> loads;
  for (const PassInfo &pass : run.manifest.passes)
    if (std::isfinite(pass.load * factor_between("N", unit)))
      loads.push_back({pass.name, pass.load * factor_between("N", unit), not_stored, not_stored});
  if (!loads.empty())
    return loads;
  for (const Result &result : run.results)
    if (is_of_contact(result.name, contact) && !result.at.empty()) {
      const double load = quantity_at(result, unit);
      if (std::isfinite(load))
        return std::vector<WorkingLoad>(1, {result.at, load, not_stored, not_stored});
    }
  return {};
}

// What results.json holds for this contact and pass: K3 of the first pass, "pass 2.K3" of another one.
double stored_slope(const Run &run, const ContactCurves &contact, const WorkingLoad &working,
                    const std::string &slope)
{
  const std::string K  = spring_of_contact(contact.name);
  const Result *result = run.find(result_name({working.name, K, slope}));
  if (!result && working.name == contact.loads.front().name)
    result = run.find(result_name({K, slope}));
  return result ? result->value * factor_between(result->unit, contact.stiffness) : not_stored;
}

// A stiffness of the table at one load.  The compliance of a line contact is a straight line over ln(load), so it
// is the compliance that is interpolated.
double stiffness_at(const ContactCurves &contact, const Table &table, const char *column, const double load)
{
  return 1 / interpolated(values_of(table, {"load", contact.load}),
                          values_of(table, {column, contact.stiffness}).cwiseInverse(), load);
}

// The stored result; without it the curve at the working load.
double slope_at(const ContactCurves &contact, const WorkingLoad &working, const char *column, const double stored)
{
  return std::isfinite(stored) ? stored : stiffness_at(contact, *contact.curve, column, working.load);
}

// Where the computed secant stands among the four closed forms, load by load.
struct Band {
  double secant, lowest, highest;
};

Band band_at(const ContactCurves &contact, const WorkingLoad &working)
{
  Band band{slope_at(contact, working, "secant", working.secant), std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};
  for (const ClosedForm &form : closed_secants) {
    const double value = stiffness_at(contact, *contact.closed, form.column, working.load);
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
}  // namespace

ContactCurves contact_curves(const Run &run, const std::string &name)
{
  ContactCurves contact{name,
                        stored_curve(run, curve::contact, name),
                        stored_curve(run, curve::contact_closed, name),
                        curves_in(run, Figure::load_approach, curve::contact.family, name),
                        "kN",
                        "kN/mm",
                        {}};
  if (values_of(*contact.curve, {"load", "N"}).size() == 0) {
    contact.per_length = true;
    contact.load       = "N/mm";
    contact.stiffness  = "kN/mm per m";
  }
  contact.loads = working_loads(run, name, contact.load);
  for (WorkingLoad &working : contact.loads) {
    working.tangent = stored_slope(run, contact, working, "tangent");
    working.secant  = stored_slope(run, contact, working, "secant");
  }
  return contact;
}

std::string band_table(const ContactCurves &contact)
{
  if (!contact.closed)
    return "";
  std::string rows;
  for (const WorkingLoad &working : contact.loads) {
    const Band band = band_at(contact, working);
    if (!std::isfinite(band.secant) || !(band.lowest <= band.highest))
      continue;
    const double tangent = slope_at(contact, working, "tangent", working.tangent);
    const double hertz   = stiffness_at(contact, *contact.closed, "hertz_tangent", working.load);
    rows += "<tr><th scope=\"row\">" + escaped(working.name) + "</th><td class=\"num\">" +
            significant(working.load, 4) + "</td><td class=\"num\">" + significant(tangent, 5) +
            "</td><td class=\"num\">" + significant(hertz, 5) + " (" + percent(tangent / hertz - 1) +
            ")</td><td class=\"num\">" + significant(band.secant, 5) + "</td><td class=\"num\">" +
            significant(band.lowest, 5) + " \u2026 " + significant(band.highest, 5) + "</td><td>" +
            place_in(band) + "</td></tr>\n";
  }
  if (rows.empty())
    return "";
  const std::string unit = " [" + contact.stiffness + "]";
  return "<table><thead><tr><th>at</th><th>load [" + contact.load + "]</th><th>tangent" + unit +
         "</th><th>Hertz tangent" + unit + " (run deviates by)</th><th>secant" + unit +
         "</th><th>closed forms, secant" + unit + "</th><th>this run in the band</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table>\n";
}
}  // namespace mill::report
