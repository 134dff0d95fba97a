#include "app/trace/closed_form_parts.h"
#include "app/stages/contact/contact_stage.h"
#include "core/case/contact_inputs.h"
#include "core/case/moving_keys.h"
#include "core/model/two_cylinders.h"
#include "core/records/result_names.h"
#include "fem/contact/hertz.h"
#include "fem/contact/two_bodies.h"
#include "reduce/chain/housing_frame.h"
#include "reduce/chain/line_contact.h"
#include "reduce/chain/screwdown.h"
#include "reduce/chain/spring_chain.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

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

ClosedFormResult closed_form_contact(const FourHigh &stand, const std::string &name, const double load,
                                     const std::size_t pass)
{
  const reduce::CylinderPair pair{stand.work_roll.barrel_diameter, stand.backup_roll.barrel_diameter,
                                  facing_length(stand), stand.steel};
  ClosedFormResult r;
  r.name             = spring_of_contact(name);
  r.parameter.value  = reduce::line_contact(pair, load).tangent;
  r.parameter.unit   = "N/m";
  r.parameter.method = "Hertz line contact, infinitely long, reduce/chain/line_contact (3.5b)";
  r.parameter.at     = at_force(load);
  r.load             = load;
  r.closed           = joined(keys_in("steel", "youngs_modulus poisson_ratio"),
                              keys_in("work_roll", "barrel_diameter barrel_length axial_shift"),
                              keys_in("backup_roll", "barrel_diameter barrel_length"), load_keys(stand.passes[pass], pass));
  r.relation         = "contact of the rolls, by the mesh of both";
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

namespace {
// Keys of both bodies that a closed form reads.
KeyList closed_keys(const TwoCylinders &pair)
{
  KeyList keys;
  for (const auto &[name, body] : {std::pair<const char *, const RoundBody &>{"upper", pair.upper},
                                   std::pair<const char *, const RoundBody &>{"lower", pair.lower}})
    keys = joined(std::move(keys),
                  keys_in(name, std::string(body.plane() ? "" : "diameter ") + "rigid" +
                                    (body.rigid ? "" : " youngs_modulus poisson_ratio")),
                  body.rigid || !std::isnan(body.youngs_modulus) ? KeyList{} : KeyList{"steel.youngs_modulus"},
                  body.rigid || !std::isnan(body.poisson_ratio) ? KeyList{} : KeyList{"steel.poisson_ratio"});
  return keys;
}

struct ClosedFormContact {
  const TwoCylinders &pair;
  MovingKeys *keys;
  KeyList closed;
  std::string prefix;
  OperatingPoint at;
  std::string method, file;
  std::vector<ClosedFormResult> all = {};
  void add(const char *name, const char *unit, const double value, const char *equation,
           const BodyReading reading = BodyReading::pressed)
  {
    ClosedFormResult r;
    r.name             = prefix + name;
    r.parameter.value  = value;
    r.parameter.unit   = unit;
    r.parameter.method = method;
    r.parameter.at     = at;
    r.closed           = closed;
    if (keys)
      r.parameter.inputs = cylinder_keys(*keys, reading);
    r.relation   = "contact of the two cylinders";
    r.file       = file;
    r.equation   = equation;
    r.stands_for = pair.in_space ? "half spaces, fem/contact/half_space_contact"
                                 : "contact finite elements, fem/roll/contact_study";
    all.push_back(r);
  }
};

// Hertz' ellipse, or the line of Hertz and Lundberg where the contact is as long as the faces.
std::vector<ClosedFormResult> closed_form_space(const TwoCylinders &pair, MovingKeys *keys)
{
  const contact::SpaceShape shape = contact::space_shape(pair);
  const double load               = pair.space.at;
  ClosedFormContact c{
      pair, keys, closed_keys(pair), "contact.space.", {"{}", {{load, "N"}}}, "", "fem/contact/space_contact"};
  c.closed = joined(std::move(c.closed), keys_in("contact.space", "at"));
  if (shape.is_point(load, pair.space.tilt)) {
    const auto e = contact::hertz_point(load, shape.radius, 1 / shape.curvature, shape.modulus);
    c.method     = "Hertz, fem/contact/hertz (10.5)";
    for (const auto *body : {&pair.upper, &pair.lower})
      if (!body->plane())
        c.closed = joined(std::move(c.closed), keys_in(body == &pair.upper ? "upper" : "lower", "crown_radius"));
    c.add("half_width", "m", e.semi_x, "(10.5)");
    c.add("peak_pressure", "Pa", e.peak_pressure, "(10.5)");
    c.add("approach", "m", e.approach, "(10.5)");
    c.add("secant", "N/m", e.secant, "(10.5)");
    c.add("tangent", "N/m", e.tangent, "(10.5)");
    return c.all;
  }
  const double q   = load / shape.length;
  const auto hertz = contact::hertz_line(q, shape.radius, shape.modulus);
  if (!(shape.length > 2 * hertz.half_width))
    return {};
  const auto line = contact::lundberg_line(hertz, q, shape.length, shape.modulus);
  c.method        = "Hertz and Lundberg, fem/contact/hertz (33.6)";
  c.closed        = joined(std::move(c.closed), keys_in("upper", "length"), keys_in("lower", "length"));
  c.add("half_width", "m", hertz.half_width, "(3.2)");
  c.add("peak_pressure", "Pa", hertz.peak_pressure, "(3.3)");
  const double approach = line.approach + shape.first_touch(pair.space.tilt);
  c.add("approach", "m", approach, "(33.6)");
  c.add("secant", "N/m", load / approach, "(33.6)");
  c.add("tangent", "N/m", line.tangent, "(33.6)");
  return c.all;
}
}  // namespace

std::vector<ClosedFormResult> closed_form_cylinders(const TwoCylinders &pair, MovingKeys *keys)
{
  if (pair.in_space)
    return closed_form_space(pair, keys);
  const double q  = pair.contact.at;
  const auto line = contact::line_bodies(contact::line_bodies_of(pair), q);
  ClosedFormContact c{pair,
                      keys,
                      joined(closed_keys(pair), keys_in("contact.line", "at")),
                      "contact.line.",
                      {"{}", {{q, "N/mm"}}},
                      "Hertz and Johnson, fem/contact/line_bodies (3.2) to (3.5b)",
                      "fem/roll/contact_study"};
  c.add("half_width", "m", line.half_width, "(3.2)");
  c.add("peak_pressure", "Pa", line.peak_pressure, "(3.3)");
  if (keys && holds(cylinder_keys(*keys, BodyReading::pressed), "contact.line.plane_depth"))
    c.closed = joined(std::move(c.closed), keys_in("contact.line", "plane_depth"));
  c.add("approach", "m", line.approach, "(3.4)");
  c.add("secant", "N/m2", line.secant, "(3.5a)");
  c.add("tangent", "N/m2", line.tangent, "(3.5b)", BodyReading::slope);
  return c.all;
}
}  // namespace mill
