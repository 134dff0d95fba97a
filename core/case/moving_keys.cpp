#include "core/case/moving_keys.h"
#include "core/case/chain_curves.h"
#include "core/case/estimates.h"
#include "core/case/stand_rows.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
// The ground profile is given by a table or by a polynomial; a case with both is refused.
bool has_one_profile(const Roll &roll)
{
  return roll.crown_table.empty() || roll.crown_polynomial.empty();
}

WorkRollInput written_work_roll(const Roll &roll)
{
  WorkRollInput input;
  static_cast<Roll &>(input) = roll;
  input.total_length         = roll.barrel_length + 2 * roll.neck_length;
  return input;
}

bool take_work_roll(const WorkRollInput &input, Roll &roll)
{
  if (!has_one_profile(input))
    return false;
  // The necks follow the lengths alone, so that no other row moves them by rounding.
  const WorkRollInput before = written_work_roll(roll);
  const bool longer = input.total_length != before.total_length || input.barrel_length != before.barrel_length;
  roll              = input;
  if (longer)
    roll.neck_length = (input.total_length - input.barrel_length) / 2;
  return true;
}

void add_rolls(CaseRows &all, FourHigh &stand)
{
  all.add("work_roll", work_roll_rows(), stand.work_roll, written_work_roll, take_work_roll);
  all.add(
      "backup_roll", backup_roll_rows(), stand.backup_roll, [](const Roll &roll) { return roll; },
      [](const Roll &input, Roll &roll) {
        if (has_one_profile(input))
          roll = input;
        return has_one_profile(input);
      });
}

// The number that represents a section [strip.friction] of Coulomb's law.
StripInput written_strip(const Strip &strip)
{
  StripInput input;
  static_cast<Strip &>(input) = strip;
  input.coulomb               = plain_coefficient(strip.friction);
  return input;
}

bool take_strip(const StripInput &input, Strip &strip)
{
  const double before = plain_coefficient(strip.friction);
  strip               = input;
  if (!std::isnan(before))
    strip.friction.coefficient = input.coulomb;
  return true;
}

// [strip] with both of its laws, or with that of the flow stress where [oil] says the friction.
void add_strip(CaseRows &all, Strip &strip, const std::vector<Field<StripInput>> &rows = strip_rows(),
               const bool oiled = false)
{
  all.add("strip", rows, strip, written_strip, take_strip);
  const auto law = [&](const char *section, const auto &rows_of_law, auto &kept, auto input, const auto &named) {
    all.add(
        section, rows_of_law, kept,
        [input](const auto &record) {
          auto written                                           = input;
          static_cast<std::decay_t<decltype(record)> &>(written) = record;
          written.name                                           = name_of(record.law);
          return written;
        },
        [named](const auto &written, auto &record) {
          record     = written;
          record.law = named(written.name);
          return true;
        });
  };
  law("strip.flow_stress", flow_stress_rows(), strip.flow_stress, FlowStressInput(), flow_stress_law);
  if (!oiled)
    law("strip.friction", friction_rows(), strip.friction, FrictionInput(), friction_law);
}

// A fit needs values that were measured, so that none is added to a case without them.
void add_bite(CaseRows &all, BiteSetup &bite)
{
  all.add(
      "bite", bite_rows(), bite, [](const BiteSetup &kept) { return kept; },
      [](const BiteSetup &changed, BiteSetup &kept) {
        const bool refused = kept.fit.empty() && !changed.fit.empty();
        if (!refused)
          kept = changed;
        return !refused;
      });
}

void add_bite_roll(CaseRows &all, double &of_case)
{
  all.add(
      "work_roll", bite_roll_rows(), of_case, [](const double diameter) { return BiteRollInput{diameter}; },
      [](const BiteRollInput &input, double &diameter) {
        diameter = input.diameter;
        return true;
      });
}

template <class Spec> void add_bearings(CaseRows &all, Spec &spec)
{
  for (RollerBearing &bearing : spec.bearings)
    all.add("bearing." + bearing.name, bearing_rows(), bearing);
  for (OilFilmBearing &film : spec.oil_films)
    all.add("bearing." + film.name, oil_film_rows(), film);
}

// A part that the case does not draw is not added, since it takes the place of other keys.
// @param parts  lengths without which a part is not drawn
template <class Drawing>
void add_drawn(CaseRows &all, const char *section, const std::vector<Field<Drawing>> &rows, Drawing &drawing,
               const std::vector<double Drawing::*> &parts)
{
  all.add(
      section, rows, drawing, [](const Drawing &kept) { return kept; },
      [parts](const Drawing &changed, Drawing &kept) {
        const bool refused = std::any_of(parts.begin(), parts.end(), [&](const auto part) {
          return std::isnan(kept.*part) && !std::isnan(changed.*part);
        });
        if (!refused)
          kept = changed;
        return !refused;
      });
}

// What moves and turns in a stand, drawn or lumped.
template <class Stand>
void add_motion(CaseRows &all, Stand &stand, const std::vector<Field<CampbellSettings>> &campbell)
{
  all.add("frequency_response", frequency_response_rows(), stand.frequency_response);
  all.add("campbell", campbell, stand.campbell);
  for (std::size_t i = 0; i < stand.drive.size(); ++i)
    all.add(fmt::format("drive.order.{}", i), drive_order_rows(), stand.drive[i]);
}

// A measured mill modulus; it is not a row of the frame that follows it.
void add_modulus(CaseRows &all, Frame &frame)
{
  if (std::isnan(frame.modulus))
    return;
  all.add(
      "frame", estimate_rows(), frame,
      [](const Frame &kept) {
        return EstimateInput{true, kept.modulus, kept.modulus_error};
      },
      [](const EstimateInput &input, Frame &kept) {
        if (!input.estimate)
          return false;
        kept.modulus       = input.modulus;
        kept.modulus_error = input.modulus_tolerance;
        return true;
      });
}

void add_rows(CaseRows &all, FourHigh &stand)
{
  all.add("steel", steel_rows(), stand.steel);
  add_rolls(all, stand);
  add_bearings(all, stand);
  all.add("frame", frame_rows(), stand.frame);
  add_modulus(all, stand.frame);
  add_drawn(all, "housing", housing_rows(), stand.housing, {&MillHousing::thickness});
  add_drawn(all, "screwdown", screwdown_rows(), stand.screwdown,
            {&Screwdown::stroke, &Screwdown::piston_length, &Screwdown::screw_length, &Screwdown::nut_height,
             &Screwdown::load_cell_height});
  add_strip(all, stand.strip);
  for (std::size_t p = 0; p < stand.passes.size(); ++p)
    add_pass_rows(all, p, pass_rows(), stand.passes[p]);
  all.add("contact.upper", roll_contact_rows(), stand.upper_contact);
  all.add("contact.lower", roll_contact_rows(), stand.lower_contact);
  add_bite(all, stand.bite);
  all.add("dynamics", dynamics_rows(), stand.dynamics);
  add_motion(all, stand, campbell_rows());
  all.add("stand", stand_span_rows(), stand.span);
  all.add("analysis", chatter_analysis_rows(), stand.analysis);
}

void add_rows(CaseRows &all, Lumped &lumped)
{
  if (lumped.detailed)
    all.add("model", model_file_rows(), lumped.model);
  all.add("curve", chain_curve_rows(), lumped.curves);
  for (std::size_t p = 0; p < lumped.passes.size(); ++p)
    add_pass_rows(all, p, pass_rows(), lumped.passes[p]);
  all.add("dynamics", chain_dynamics_rows(), lumped.dynamics);
  add_motion(all, lumped, chain_campbell_rows());
}

// A cylinder has a diameter and a plane has none.
void add_body(CaseRows &all, const char *section, const std::vector<Field<RoundBody>> &rows, RoundBody &body)
{
  all.add(
      section, rows, body, [](const RoundBody &kept) { return kept; },
      [](const RoundBody &changed, RoundBody &kept) {
        const bool refused = changed.plane() && !std::isnan(changed.diameter);
        if (!refused)
          kept = changed;
        return !refused;
      });
}

void add_rows(CaseRows &all, TwoCylinders &pair)
{
  all.add("steel", steel_rows(), pair.steel);
  add_body(all, "upper", upper_body_rows(), pair.upper);
  add_body(all, "lower", lower_body_rows(), pair.lower);
  if (pair.in_space)
    all.add("contact.space", space_contact_rows(), pair.space);
  else
    all.add("contact.line", line_contact_rows(), pair.contact);
}

void add_rows(CaseRows &all, BearingCase &spec)
{
  add_bearings(all, spec);
  all.add("load", bearing_load_rows(), spec.load);
  for (RollerBearing &bearing : spec.bearings)  // [model] says again what the loaded one says
    if (bearing.name == spec.load.bearing)
      all.add(
          "model", bearing_model_rows(), bearing,
          [](const RollerBearing &kept) {
            return BearingModelInput{kept.roller_law, kept.rings, kept.slices};
          },
          [](const BearingModelInput &input, RollerBearing &kept) {
            kept.roller_law = input.roller_law.value_or(kept.roller_law);
            kept.rings      = input.rings.value_or(kept.rings);
            kept.slices     = input.slices;
            return true;
          });
  all.add("dynamics", bearing_motion_rows(), spec.motion);
}

void add_rows(CaseRows &all, BiteCase &spec)
{
  all.add("steel", steel_rows(), spec.steel);
  add_bite_roll(all, spec.roll_diameter);
  add_strip(all, spec.strip);
  for (std::size_t p = 0; p < spec.passes.size(); ++p)
    add_pass_rows(all, p, bite_pass_rows(), spec.passes[p]);
  add_bite(all, spec.bite);
}

// [oil] with its law of friction.
void add_oil(CaseRows &all, Friction &friction)
{
  const auto add = [&](const char *section, const std::vector<Field<OilInput>> &rows) {
    all.add(
        section, rows, friction,
        [](const Friction &kept) {
          OilInput input;
          static_cast<Friction &>(input) = kept;
          return input;
        },
        [](const OilInput &input, Friction &kept) {
          kept = input;
          return true;
        });
  };
  add("oil", oil_rows());
  add("oil.friction", oil_friction_rows());
}

// What [stand] leaves open is that of its file, what a variant leaves open that of [stand]; neither is added.
void add_chatter_stand(CaseRows &all, const std::string &section, ChatterStand &stand)
{
  all.add(
      section, chatter_stand_rows(), stand, [](const ChatterStand &kept) { return kept; },
      [](const ChatterStand &changed, ChatterStand &kept) {
        const auto adds = [](const double before, const double now) {
          return std::isnan(before) && !std::isnan(now);
        };
        const bool refused =
            adds(kept.masses[0], changed.masses[0]) || adds(kept.stiffnesses[0], changed.stiffnesses[0]) ||
            adds(kept.dampings[0], changed.dampings[0]) || adds(kept.entry_distance, changed.entry_distance) ||
            adds(kept.exit_distance, changed.exit_distance);
        if (!refused)
          kept = changed;
        return !refused;
      });
}

void add_rows(CaseRows &all, ChatterCase &spec)
{
  all.add("steel", chatter_steel_rows(), spec.steel);
  add_bite_roll(all, spec.roll_diameter);
  add_strip(all, spec.strip, chatter_strip_rows(), spec.oiled);
  if (spec.oiled)
    add_oil(all, spec.strip.friction);
  add_chatter_stand(all, "stand", spec.stand);
  for (ChatterVariant &variant : spec.variants)
    add_chatter_stand(all, "variant." + variant.name, variant.stand);
  for (std::size_t i = 0; i < spec.conditions.size(); ++i)
    all.add(fmt::format("condition.{}", i), condition_rows(), spec.conditions[i]);
  all.add("analysis", chatter_analysis_rows(), spec.analysis);
}

void add_rows(CaseRows &, ClusterCase &) {}
void add_rows(CaseRows &, StackCase &) {}
}  // namespace

void add_pass_rows(CaseRows &all, const std::size_t p, const std::vector<Field<PassInput>> &rows, Pass &pass)
{
  all.add(
      fmt::format("pass.{}", p), rows, pass,
      [](const Pass &kept) {
        PassInput input;
        static_cast<Pass &>(input) = kept;
        return input;
      },
      [](const PassInput &input, Pass &kept) {
        kept = input;
        return true;
      });
}

MovingKeys::MovingKeys(CaseSpec of_case) : kept(std::move(of_case)), changed(kept)
{
  std::visit([&](auto &spec) { add_rows(rows, spec); }, changed);
}

const KeyList &MovingKeys::of(const std::string &what, const Text &text)
{
  const std::lock_guard<std::mutex> one_list(making);
  const auto made = known.find(what);
  return made != known.end() ? made->second
                             : known.emplace(what, rows.moving([&] { return text(changed); })).first->second;
}
}  // namespace mill
