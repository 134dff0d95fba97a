#include "app/trace/quick_parts.h"
#include "app/stages/contact_stage.h"
#include "core/model/two_cylinders.h"
#include "reduce/chain/housing_frame.h"
#include "reduce/chain/line_contact.h"
#include "reduce/chain/screwdown.h"
#include "reduce/chain/spring_chain.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill {
namespace {
// Length on which the barrels face each other.
double facing_length(const FourHigh &stand)
{
  const double shift = stand.work_roll.axial_shift, work = 0.5 * stand.work_roll.barrel_length,
               backup = 0.5 * stand.backup_roll.barrel_length;
  return std::min(backup, shift + work) - std::max(-backup, shift - work);
}

}  // namespace

QuickResult quick_contact(const FourHigh &stand, const std::string &name, const double load,
                          const std::size_t pass)
{
  const reduce::CylinderPair pair{stand.work_roll.barrel_diameter, stand.backup_roll.barrel_diameter,
                                  facing_length(stand), stand.steel};
  QuickResult r;
  r.name             = name == "upper" ? "K3" : "K5";
  r.parameter.value  = reduce::line_contact(pair, load).tangent;
  r.parameter.unit   = "N/m";
  r.parameter.method = "Hertz line contact, infinitely long, reduce/chain/line_contact (3.5b)";
  r.parameter.at     = in_kN(load);
  r.load             = load;
  r.closed           = joined(keys_in("steel", "youngs_modulus poisson_ratio"),
                              keys_in("work_roll", "barrel_diameter barrel_length axial_shift"),
                              keys_in("backup_roll", "barrel_diameter barrel_length"), load_keys(stand.passes[pass], pass));
  r.road             = "contact of the rolls, by the mesh of both";
  r.file             = "reduce/chain/contact_stiffness";
  r.equation         = "(3.7)";
  r.stands_for       = "contact finite elements, fem/roll/contact_study";
  return r;
}

namespace {
double given_value(const FourHigh &stand, const std::string &name)
{
  const auto given = stand.given.find(name);
  return given == stand.given.end() ? not_given : given->second.parameter.value;
}
}  // namespace

FourHigh with_drawn_frame(FourHigh stand)
{
  Frame &f = stand.frame;
  if (stand.housing.present()) {
    const auto h           = reduce::housing_frame(stand.housing);
    f.upper_post_stiffness = 1 / h.flexibility[reduce::upper_post];
    f.upper_beam_stiffness = 1 / h.flexibility[reduce::upper_beam];
    f.lower_post_stiffness = 1 / h.flexibility[reduce::lower_post];
    f.lower_beam_stiffness = 1 / h.flexibility[reduce::lower_beam];
    f.upper_post_mass      = h.reduced_mass[reduce::upper_post];
    f.upper_beam_mass      = h.reduced_mass[reduce::upper_beam];
    f.lower_post_mass      = h.reduced_mass[reduce::lower_post];
    f.lower_beam_mass      = h.reduced_mass[reduce::lower_beam];
  }
  f = reduce::frame_with_screwdown(f, stand.screwdown, stand.steel).frame;
  if (stand.housing.present())
    f = reduce::with_masses_at_the_chain(f, given_value(stand, "K1"), given_value(stand, "K7"));
  return stand;
}

std::vector<QuickResult> quick_cylinders(const TwoCylinders &pair)
{
  const double q     = pair.contact.at;
  const auto contact = reduce::line_contact({pair.upper_diameter, pair.lower_diameter, 1, pair.steel}, q);
  std::vector<QuickResult> all;
  const auto add = [&](const char *name, const char *unit, const double value, const char *equation) {
    QuickResult r;
    r.name             = std::string("contact.line.") + name;
    r.parameter.value  = value;
    r.parameter.unit   = unit;
    r.parameter.method = "Hertz and Johnson, reduce/chain/line_contact (3.2) to (3.5b)";
    r.parameter.at     = fmt::format("{:.6g} N/mm", q / 1e3);
    r.closed           = joined(keys_in("upper", "diameter"), keys_in("lower", "diameter"),
                                keys_in("steel", "youngs_modulus poisson_ratio"), keys_in("contact.line", "at"));
    r.parameter.inputs = cylinder_keys(r.name);
    r.road             = "contact of the two cylinders";
    r.file             = "fem/roll/contact_study";
    r.equation         = equation;
    r.stands_for       = "contact finite elements, fem/roll/contact_study";
    all.push_back(r);
  };
  add("half_width", "m", contact.half_width, "(3.2)");
  add("peak_pressure", "Pa", contact.peak_pressure, "(3.3)");
  add("approach", "m", contact.approach, "(3.4)");
  add("secant", "N/m2", contact.secant, "(3.5a)");
  add("tangent", "N/m2", contact.tangent, "(3.5b)");
  return all;
}
}  // namespace mill
