#include "core/records/contact_name.h"
#include "report/contact/curves.h"
#include "report/contact/pressure_map.h"
#include "report/page/curves.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg_plot.h"
#include "report/results/names.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace mill::report {
namespace {
// Of the curves that share a figure, in the order of the table of curves.
constexpr std::array<Pen, 5> pens_of_loads{Pen::dark, Pen::dark_dashed, Pen::pale, Pen::pale_dashed, Pen::dotted};
constexpr std::array<Pen, 5> pens_of_barrels{Pen::dark, Pen::warm, Pen::dashed, Pen::pale, Pen::dotted};

// Approach of a closed form in µm from its load and secant.
Line closed_approach(const ContactCurves &contact, const ClosedForm &form)
{
  const bool per_length        = contact.per_length;
  const Eigen::VectorXd load   = values_of(*contact.closed, {"load", per_length ? "N/m" : "N"});
  const Eigen::VectorXd secant = values_of(*contact.closed, {form.column, per_length ? "N/m\u00b2" : "N/m"});
  if (load.size() == 0 || secant.size() != load.size())
    return {};
  return {form.label, 1e6 * load.cwiseQuotient(secant), 1e-3 * load, form.pen_of_curve};
}

std::string load_approach(const ContactCurves &contact)
{
  Plot plot;
  plot.title = "Load over approach";
  plot.x     = {"approach of the axes", "\u00b5m"};
  plot.y     = {"load on the contact", contact.load};
  plot.x.low = plot.y.low = 0;
  for (std::size_t i = 0; i < contact.curves.size(); ++i)
    add_line(plot, *contact.curves[i].table, {"approach", "\u00b5m"}, {"load", contact.load},
             contact.curves[i].kind->title, pens_of_loads[i % pens_of_loads.size()], i == 0);
  if (contact.closed)
    for (const ClosedForm &form : closed_secants)
      if (Line line = closed_approach(contact, form); line.x.size() > 0)
        plot.lines.push_back(std::move(line));
  const Eigen::VectorXd load     = values_of(*contact.curve, {"load", contact.load}),
                        approach = values_of(*contact.curve, {"approach", "\u00b5m"});
  for (const WorkingLoad &working : contact.loads)
    plot.points.push_back({interpolated(load, approach, working.load), working.load, working.name});
  return svg_plot(plot);
}

std::string stiffness_over_load(const ContactCurves &contact)
{
  Plot plot;
  plot.title     = "Stiffness over load";
  plot.x         = {"load on the contact", contact.load, Scale::logarithmic};
  plot.y         = {"stiffness", contact.stiffness};
  const auto add = [&](const Table *table, const char *column, const std::string &label, const Pen pen,
                       const bool markers = false) {
    if (table)
      add_line(plot, *table, {"load", contact.load}, {column, contact.stiffness}, label, pen, markers);
  };
  for (std::size_t i = 0; i < contact.curves.size(); ++i)
    add(contact.curves[i].table, "tangent", std::string("tangent, ") + contact.curves[i].kind->title,
        pens_of_loads[i % pens_of_loads.size()], i == 0);
  add(contact.closed, "hertz_tangent", "tangent, Hertz", Pen::warm);
  add(contact.curve, "secant", "secant, this run", Pen::dashed, true);
  for (const ClosedForm &form : closed_secants)
    add(contact.closed, form.column, std::string("secant, ") + form.label, form.pen_of_slopes);
  for (const WorkingLoad &working : contact.loads)
    plot.marks.push_back({working.load, working.name});
  return svg_plot(plot);
}

std::string along_barrel(const std::vector<StoredCurve> &curves, const char *column, const char *quantity,
                         const char *unit)
{
  Plot plot;
  plot.title  = quantity;
  plot.width  = 333;
  plot.height = 260;
  plot.x      = {"distance from mid-length", "mm"};
  plot.y      = {quantity, unit};
  plot.y.low  = 0;
  for (std::size_t i = 0; i < curves.size(); ++i)
    add_line(plot, *curves[i].table, {"z", "mm"}, {column, unit}, curves.size() > 1 ? curves[i].kind->title : "",
             pens_of_barrels[i % pens_of_barrels.size()], i == 0);
  return svg_plot(plot);
}

std::string band_caption(const bool plane_strain)
{
  return std::string(
             "The computed stiffness among the closed forms of a line contact. The forms differ in the pressure "
             "they assume and in the body that carries it; the half space replaces the larger roll by a body "
             "without a far side. ") +
         (plane_strain
              ? "The cylinders of this case are long, as Hertz assumes: his form, axis to axis, is the reference."
              : "No closed form is exact here: they all leave out the ends and necks of a barrel, where load and "
                "stiffness per length change.");
}

// Why the secant lies where it does in the band: what belongs to the section and what to the barrel ends.
std::string why_in_band(const Run &run, const std::string &name)
{
  const Result *secant = run.find(result_name({spring_of_contact(name), "secant"}));
  if (!secant || is_contact(name, ContactName::line))
    return "";
  const double closed  = value_beside(secant->checks, CheckId::johnson_secant),
               section = value_beside(secant->checks, CheckId::middle_section),
               held    = value_beside(secant->checks, CheckId::held_as_in_stand);
  if (!(closed > 0) || !(section > 0))
    return "";
  if (std::abs(section / closed - 1) > 0.05)
    return "With a profile, a tilt or an off-centre force this is not a line contact under an even load: the "
           "closed forms show how far it is from one, not which value is right.";
  const auto off = [](const double ratio) { return percent(ratio - 1); };
  return "Reason: compared with Johnson's infinitely long rolls the section at mid-length, taken over the whole "
         "length, has " +
         off(section / closed) +
         ", since a roll that is free to stretch along its axis is not quite in plane strain; barrel ends and "
         "necks "
         "add " +
         off(secant->value / section) + "; together " + off(secant->value / closed) + "." +
         (held > 0
              ? " Held as in the stand the same pair has " + off(held / secant->value) +
                    " against this: the backup roll is balanced by shear from its necks and not by an opposite "
                    "contact, both rolls bend, and the strip is narrower than the barrel."
              : "");
}

// The same pair under the same loads has the same curves to the last bit.
bool same_contact(const Run &run, const std::string &a, const std::string &b)
{
  for (const CurveKind *kind :
       {&curve::contact, &curve::contact_closed, &curve::contact_barrel, &curve::contact_pressure}) {
    const Table *one = stored_curve(run, *kind, a), *other = stored_curve(run, *kind, b);
    if (!one != !other || (one && (one->names != other->names || one->columns != other->columns)))
      return false;
  }
  return true;
}

/// @param also  another contact with the same curves; empty: none
void one_contact(Page &page, const Run &run, const std::string &name, const std::string &also)
{
  const ContactCurves contact = contact_curves(run, name);
  std::string title           = contact_title(name) + (also.empty() ? "" : ", the same as " + contact_title(also));
  title[0]                    = char(std::toupper(static_cast<unsigned char>(title[0])));
  page.heading(title);
  page.figure(
      {load_approach(contact), stiffness_over_load(contact)},
      "Left: how far the two roll axes come together under the load; the dots are the solved loads, the "
      "circles the working loads. Right: the two slopes of that curve. The <b>tangent</b> is the stiffness for "
      "vibration, the <b>secant</b> that for screwing down; both grow only with the logarithm of the load. "
      "Small steps of a computed tangent are rows of the mesh that come into contact." +
          std::string(stored_curve(run, curve::contact_in_stand, name)
                          ? " This run squeezes each roll evenly between two contacts, as the closed forms "
                            "do; dashed, the rolls are held as in the stand and bend as well."
                          : ""));
  if (!contact.closed && !is_contact(name, ContactName::space))
    page.absent("Closed forms for the contact curve are", curve_path(curve::contact_closed, name) + ".csv");
  else if (const std::string table = band_table(contact); !table.empty()) {
    page.table(table, band_caption(is_contact(name, ContactName::line)));
    if (const std::string why = why_in_band(run, name); !why.empty())
      page.paragraph(why);
  }
  const std::vector<StoredCurve> barrel = curves_in(run, Figure::barrel, curve::contact.family, name);
  const bool mirrored                   = stored_curve(run, curve::contact_barrel_mirrored, name);
  const bool second                     = stored_curve(run, curve::contact_barrel_second, name);
  if (stored_curve(run, curve::contact_barrel, name))
    page.figure(
        {along_barrel(barrel, "line_load", "line load q", "kN/mm"),
         along_barrel(barrel, "tangent", "tangent per length k", "kN/mm per m"),
         along_barrel(barrel, "peak_pressure", "peak pressure p\u2080", "MPa")},
        "Along the barrel: load per length, stiffness per length and largest pressure; from mid-length when both "
        "sides carry the same. A flat line is what a plane-strain formula assumes; what it does towards the end "
        "is "
        "the effect of the barrel end and of the crown. The very last point belongs to a sharp edge, where the "
        "pressure is singular." +
            std::string(mirrored
                            ? " Held as in the stand, the rolls also bend; squeezed evenly between two opposite "
                              "contacts, they do not."
                            : "") +
            std::string(second ? " The Fourier solver, a series around the roll, shares neither mesh nor solver "
                                 "with the first: where the lines lie on one another, both are right."
                               : ""));
  else if (is_of_stand(name))
    page.absent("The distribution along the barrel is", curve_path(curve::contact_barrel, name) + ".csv");
  if (const Table *map = stored_curve(run, curve::contact_pressure, name))
    page.figure(
        {pressure_map(*map, "Contact pressure", "distance from mid-length")},
        is_contact(name, ContactName::space)
            ? "Pressure over the contact patch by boundary elements on half spaces, mean of each rectangle; from "
              "mid-length when both sides carry the same. The two directions have scales of their own. Where a "
              "sharp end carries, the last row is as high as the grid is fine."
            : "Pressure over the contact patch, rolls held as in the stand; across, the picture is stretched "
              "several "
              "hundred times. The width shows how far the crown is closed and where an edge carries.");
  if (const Table *map = stored_curve(run, curve::contact_slip, name))
    page.figure({patch_map(*map, {"used", "friction used", "-"}, "Stick and slip", "distance from mid-length"),
                 patch_map(*map, {"shear", "shear", "MPa"}, "Shear along the tangential load",
                           "distance from mid-length")},
                "Above: shear over friction times pressure; where it is 1 the surfaces slip, below that they "
                "stick. Below: the shear itself. The part that symmetry leaves is shown.");
  own_figures(page, run, curve::contact.family, name);
}
}  // namespace

void contact_section(Page &page, const Run &run)
{
  const auto contacts = items_of(run, curve::contact);
  if (contacts.empty() && (run.manifest.kind == KindOfCase::lumped || run.manifest.kind == KindOfCase::bearing ||
                           run.manifest.kind == KindOfCase::bite || run.manifest.kind == KindOfCase::chatter ||
                           run.manifest.kind == KindOfCase::cluster))
    return;
  page.section("contact", "Roll contact");
  if (contacts.empty())
    page.absent("Contact figures are", curve_path(curve::contact, "*") + ".csv");
  std::vector<std::string> shown;
  for (const std::string &name : contacts) {
    if (std::any_of(shown.begin(), shown.end(),
                    [&](const std::string &before) { return same_contact(run, before, name); }))
      continue;
    shown.push_back(name);
    std::string also;
    for (const std::string &other : contacts)
      if (std::find(shown.begin(), shown.end(), other) == shown.end() && same_contact(run, name, other))
        also = other;
    one_contact(page, run, name, also);
  }
}
}  // namespace mill::report
