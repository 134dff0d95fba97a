#include "core/case/chain_inputs.h"
#include "core/case/modulus_inputs.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/case/stand_rows.h"
#include "core/model/four_high.h"
#include "core/model/lumped.h"
#include "core/records/record_text.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using FrameParts = std::vector<double Frame::*>;

bool is_one_of(const FrameParts &parts, double Frame::*part)
{
  return std::find(parts.begin(), parts.end(), part) != parts.end();
}

const FrameParts &drawn_masses()
{
  static const FrameParts parts{&Frame::upper_post_mass, &Frame::upper_beam_mass, &Frame::lower_post_mass,
                                &Frame::lower_beam_mass};
  return parts;
}

const FrameParts &drawn_springs()
{
  static const FrameParts parts{&Frame::upper_post_stiffness, &Frame::upper_beam_stiffness,
                                &Frame::lower_post_stiffness, &Frame::lower_beam_stiffness};
  return parts;
}

std::string text_of_housing(const FourHigh &stand, const bool masses, const ChainReading reading)
{
  const MillHousing &h = stand.housing;
  std::string text =
      record_text(h.thickness, h.post_width, h.window_width, h.window_height, h.upper_beam_height,
                  h.lower_beam_height, h.foot_height, h.screw_pad, h.seat_pad,
                  std::isnan(h.modulus) ? stand.steel.youngs_modulus : h.modulus, stand.steel.poisson_ratio);
  if (masses)
    text += record_text(std::isnan(h.density) ? stand.steel.density : h.density);
  return reading == ChainReading::run ? text + record_text(h.fillet_radius) : text;
}

// Empty: it is not drawn.  The springs are those of reduce/chain/screwdown.
std::string text_of_screwdown(const FourHigh &stand, double Frame::*part)
{
  const Screwdown &s = stand.screwdown;
  const double E     = stand.steel.youngs_modulus;
  std::string text;
  if (part == &Frame::oil_column_stiffness && !std::isnan(s.stroke))
    text = record_text(s.stroke, s.piston_diameter, s.oil_modulus);
  if (part == &Frame::load_cell_stiffness && !std::isnan(s.load_cell_height))
    text = record_text(s.load_cell_height, s.load_cell_diameter, s.load_cell_bore, E);
  if (part != &Frame::piston_stiffness)
    return text;
  if (!std::isnan(s.screw_length))
    text += record_text(s.screw_length, s.screw_diameter, E);
  if (!std::isnan(s.nut_height))
    text += record_text(s.nut_height, s.nut_outside_diameter, s.nut_modulus, s.screw_diameter, E);
  if (!std::isnan(s.piston_length))
    text += record_text(s.piston_length, s.piston_diameter, E);
  return text;
}

std::string text_of_part(const FourHigh &stand, double Frame::*part, const ChainReading reading)
{
  const bool mass = is_one_of(drawn_masses(), part);
  if (stand.housing.present() && (mass || is_one_of(drawn_springs(), part)))
    return text_of_housing(stand, mass, reading);
  const std::string drawn = text_of_screwdown(stand, part);
  return drawn.empty() ? record_text(stand.frame.*part) : drawn;
}

bool is_upper(const RollPlace roll)
{
  return roll == RollPlace::upper_backup || roll == RollPlace::upper_work;
}

std::string text_of_moving_roll(const FourHigh &stand, const RollPlace place)
{
  const Roll &roll = is_work_roll(place) ? stand.work_roll : stand.backup_roll;
  std::string text = record_text(roll.barrel_diameter, roll.barrel_length, roll.neck_diameter, roll.neck_length,
                                 roll.bearing_span, roll.bearing_mass, stand.steel.density,
                                 is_upper(place) ? roll.chock_mass_upper : roll.chock_mass_lower);
  if (is_work_roll(place))
    text += record_text(stand.strip.width, stand.steel.youngs_modulus);
  if (place == RollPlace::upper_backup)
    text += record_text(stand.frame.cylinder_mass, stand.frame.balance_mass);
  return text;
}

const DynamicsSettings &motion_of(const CaseSpec &spec)
{
  const auto *stand = std::get_if<FourHigh>(&spec);
  return stand ? stand->dynamics : std::get<Lumped>(spec).dynamics;
}
}  // namespace

KeyList frame_keys(MovingKeys &keys, const FrameParts &parts, const ChainReading reading)
{
  std::string what = fmt::format("frame {}", int(reading));
  for (const Field<Frame> &row : frame_rows())
    if (const auto *part = std::get_if<double Frame::*>(&row.member); part && is_one_of(parts, *part))
      what += std::string(" ") + row.key;
  return keys.of(what, [&](const CaseSpec &spec) {
    std::string text;
    for (const auto part : parts)
      text += text_of_part(std::get<FourHigh>(spec), part, reading);
    return text;
  });
}

KeyList housing_keys(MovingKeys &keys, const bool masses, const ChainReading reading)
{
  return keys.of(fmt::format("housing {} {}", masses, int(reading)),
                 [&](const CaseSpec &spec) { return text_of_housing(std::get<FourHigh>(spec), masses, reading); });
}

KeyList bare_housing_keys(MovingKeys &keys)
{
  return keys.of("bare housing", [](const CaseSpec &spec) {
    const auto &stand = std::get<FourHigh>(spec);
    return text_of_housing(stand, true, ChainReading::run) + record_text(stand.dynamics.frequency_limit);
  });
}

KeyList closure_keys(MovingKeys &keys)
{
  const KeyList modulus = keys.of("modulus of the frame", [](const CaseSpec &spec) {
    return record_text(std::get<FourHigh>(spec).frame.modulus);
  });
  const bool rolls      = !std::get<FourHigh>(keys.spec()).passes.empty();
  return rolls ? joined(modulus, touching_roll_keys(keys, 0)) : modulus;
}

KeyList bent_backup_keys(MovingKeys &keys, const bool solid, const bool scaled)
{
  return keys.of(fmt::format("bent backup roll {} {}", solid, scaled), [&](const CaseSpec &spec) {
    const auto &stand                = std::get<FourHigh>(spec);
    const Roll &roll                 = stand.backup_roll;
    const DynamicsSettings &dynamics = stand.dynamics;
    std::string text = record_text(roll.barrel_diameter, roll.barrel_length, roll.neck_diameter, roll.bearing_span,
                                   roll.bending_model, stand.steel.poisson_ratio, dynamics.mass_reference);
    if (!scaled)
      text += record_text(stand.steel.youngs_modulus);
    if (solid)
      text += record_text(roll.neck_length, dynamics.elements_per_radius, dynamics.frequency_limit);
    return text;
  });
}

KeyList moving_roll_keys(MovingKeys &keys, const RollPlace roll)
{
  return keys.of(std::string("moving ") + word_of(roll),
                 [&](const CaseSpec &spec) { return text_of_moving_roll(std::get<FourHigh>(spec), roll); });
}

KeyList mass_shape_keys(MovingKeys &keys)
{
  return keys.of("shapes of the masses", [](const CaseSpec &spec) {
    const DynamicsSettings &dynamics = motion_of(spec);
    const std::string source         = record_text(dynamics.mass_source);
    return dynamics.mass_source == MassSource::fe
               ? source + record_text(dynamics.frequency_limit, dynamics.elements_per_radius)
               : source;
  });
}

KeyList frame_form_keys(MovingKeys &keys)
{
  return keys.of("form of the frame", [](const CaseSpec &spec) { return record_text(motion_of(spec).frame); });
}

KeyList detailed_model_keys(MovingKeys &keys)
{
  return keys.of("detailed model", [](const CaseSpec &spec) {
    const DynamicsSettings &dynamics = motion_of(spec);
    return record_text(dynamics.model, dynamics.frequency_limit, dynamics.elements_per_radius);
  });
}
}  // namespace mill
