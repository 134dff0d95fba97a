#include "core/case/contact_inputs.h"
#include "core/case/moving_keys.h"
#include "core/records/contact_name.h"
#include "core/records/record_text.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// A polynomial replaces a table, and a table the crown.
Roll as_in_contact(Roll roll)
{
  const Roll none;
  if (!roll.crown_polynomial.empty())
    roll.crown_table = none.crown_table;
  if (!roll.crown_polynomial.empty() || !roll.crown_table.empty())
    roll.crown = none.crown;
  if (!roll.thermal_crown_table.empty())
    roll.thermal_crown = none.thermal_crown;
  return roll;
}

RoundBody body_as_read(RoundBody body, const bool in_space)
{
  const RoundBody none;
  if (body.plane())
    body.diameter = body.crown_radius = not_given;
  if (body.rigid)
    body.youngs_modulus = body.poisson_ratio = not_given;
  if (!in_space) {
    body.length = body.crown_radius = not_given;
    body.profile                    = none.profile;
  }
  if (body.profile != EndProfile::arc)
    body.profile_length = body.profile_drop = not_given;
  if (body.profile != EndProfile::log)
    body.profile_load = not_given;
  if (body.profile != EndProfile::table)
    body.profile_table.clear();
  return body;
}
}  // namespace

ContactInputs inputs_of_pair(const FourHigh &stand, const ContactSettings &settings)
{
  ContactInputs inputs;
  inputs.steel       = at_rest(stand.steel);
  inputs.work_roll   = as_in_contact(stand.work_roll);
  inputs.backup_roll = as_in_contact(stand.backup_roll);
  inputs.strip_width = stand.strip.width;
  inputs.settings    = settings;
  return inputs;
}

ContactInputs inputs_of_contact(const FourHigh &stand, const std::string &name, const std::size_t pass,
                                const ContactReading reading)
{
  const ContactSettings none;
  ContactInputs inputs =
      inputs_of_pair(stand, is_contact(name, ContactName::upper) ? stand.upper_contact : stand.lower_contact);
  if (reading != ContactReading::friction)
    inputs.settings.friction = none.friction;
  if (reading != ContactReading::path)
    inputs.settings.path_trim = none.path_trim;
  // Without a range of its own the sweep, and with it the mesh, is made for the loads of all passes.
  const bool has_range = !std::isnan(inputs.settings.loads[0]);
  for (std::size_t p = 0; p < stand.passes.size(); ++p)
    if (p == pass || !has_range)
      inputs.loads.push_back(inputs_of_load(stand.passes[p]));
  return inputs;
}

KeyList contact_keys(MovingKeys &keys, const std::string &name, const std::size_t pass,
                     const ContactReading reading)
{
  return keys.of(fmt::format("contact {} {} {}", name, pass, int(reading)), [&](const CaseSpec &spec) {
    return record_text(inputs_of_contact(std::get<FourHigh>(spec), name, pass, reading));
  });
}

BodyPairInputs inputs_of_bodies(const TwoCylinders &pair, const BodyReading reading)
{
  const bool slips = reading == BodyReading::slip;
  BodyPairInputs inputs;
  inputs.upper                    = body_as_read(pair.upper, pair.in_space);
  inputs.lower                    = body_as_read(pair.lower, pair.in_space);
  inputs.steel                    = {not_given, not_given};
  const RoundBody *const bodies[] = {&inputs.upper, &inputs.lower};
  for (const RoundBody *body : bodies) {
    if (!body->rigid && std::isnan(body->youngs_modulus))
      inputs.steel.youngs_modulus = pair.steel.youngs_modulus;
    if (!body->rigid && std::isnan(body->poisson_ratio))
      inputs.steel.poisson_ratio = pair.steel.poisson_ratio;
  }
  // Every load has a grid of its own in space and on half planes; a mesh is made for the whole range.
  if (pair.in_space) {
    inputs.space.at         = pair.space.at;
    inputs.space.rectangles = pair.space.rectangles;
    inputs.space.tilt       = pair.space.tilt;
    if (slips) {
      inputs.space.friction             = pair.space.friction;
      inputs.space.tangential_load      = pair.space.tangential_load;
      inputs.space.tangential_direction = pair.space.tangential_direction;
    }
    return inputs;
  }
  inputs.line.at    = pair.contact.at;
  const bool meshed = plane_engine(pair) != PlaneEngine::half_planes && !slips;
  if (slips) {
    inputs.line.friction        = pair.contact.friction;
    inputs.line.tangential_load = pair.contact.tangential_load;
  }
  if (meshed) {
    inputs.line.loads                   = pair.contact.loads;
    inputs.line.elements_per_half_width = pair.contact.elements_per_half_width;
  }
  if (meshed && reading == BodyReading::slope)
    inputs.line.samples = pair.contact.samples;
  for (const RoundBody *body : bodies)
    if (body->plane() && !body->rigid)
      inputs.line.plane_depth = pair.contact.plane_depth;
  return inputs;
}

KeyList cylinder_keys(MovingKeys &keys, const BodyReading reading)
{
  return keys.of(fmt::format("bodies {}", int(reading)), [&](const CaseSpec &spec) {
    return record_text(inputs_of_bodies(std::get<TwoCylinders>(spec), reading));
  });
}
}  // namespace mill
