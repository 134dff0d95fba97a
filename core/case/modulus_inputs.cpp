#include "core/case/modulus_inputs.h"
#include "core/case/moving_keys.h"
#include "core/case/pass_inputs.h"
#include "core/records/record_text.h"
#include <fmt/format.h>

namespace mill {
std::string text_of_touching_rolls(const FourHigh &stand, const std::size_t pass)
{
  return record_text(at_rest(stand.steel), stand.work_roll.barrel_diameter, stand.work_roll.barrel_length,
                     inputs_of_load(stand.passes[pass]));
}

std::string text_of_bent_work_rolls(const FourHigh &stand, const bool solid)
{
  const DynamicsSettings &dynamics = stand.dynamics;
  std::string text                 = record_text(stand.strip.width, dynamics.mass_reference);
  if (solid)
    text += record_text(stand.backup_roll.bending_model);
  if (solid && stand.backup_roll.bending_model == BendingModel::solid)
    return text + record_text(roll_geometry(stand.work_roll), at_rest(stand.steel), dynamics.frequency_limit,
                              dynamics.elements_per_radius);
  return text +
         record_text(stand.work_roll.barrel_diameter, stand.work_roll.barrel_length, stand.steel.youngs_modulus);
}

KeyList touching_roll_keys(MovingKeys &keys, const std::size_t p)
{
  return keys.of(fmt::format("touching rolls {}", p),
                 [&](const CaseSpec &spec) { return text_of_touching_rolls(std::get<FourHigh>(spec), p); });
}

KeyList bent_work_roll_keys(MovingKeys &keys, const bool solid)
{
  return keys.of(solid ? "bent work rolls" : "work rolls as beams",
                 [&](const CaseSpec &spec) { return text_of_bent_work_rolls(std::get<FourHigh>(spec), solid); });
}
}  // namespace mill
