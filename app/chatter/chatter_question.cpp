#include "app/chatter/chatter_question.h"
#include "app/stages/bite/bite_stage.h"
#include "app/stages/bite/free_strip.h"
#include "app/stages/response/detailed_model_stage.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modal_model.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace mill {
namespace {
using dynamics::ChatterStandModel;

bite::RollBite bite_of(const ChatterCase &spec, const RollingCondition &c)
{
  bite::RollBite bite;
  bite.strip                 = spec.strip;
  bite.strip.width           = c.width;
  bite.strip.entry_thickness = c.entry_thickness;
  bite.strip.exit_thickness  = c.exit_thickness;
  bite.strip.entry_tension   = c.entry_tension;
  bite.strip.exit_tension    = c.exit_tension;
  bite.roll_radius           = 0.5 * spec.roll_diameter;
  bite.roll                  = spec.steel;
  bite.roll_speed            = c.speed;
  return bite;
}

// The chain without strip between the rolls: the bite is what chatter adds.
DynamicsSettings chain_settings(const double modal_damping, const FrameForm frame)
{
  DynamicsSettings settings;
  settings.modal_damping = modal_damping;
  settings.force_meaning = ForceMeaning::measured;
  settings.frame         = frame;
  return settings;
}

dynamics::StandStructure chain_structure(const LumpedModel &model, const DynamicsSettings &settings)
{
  return dynamics::structure_of(dynamics::mill_model(model, settings));
}

std::array<double, 6> masses_of(const LumpedModel &model)
{
  std::array<double, 6> m;
  for (std::size_t i = 0; i < 6; ++i)
    m[i] = model.M[i].value;
  return m;
}

// K1, K2, K3, K5, K6, K7: the bite's K4 is left out.
std::array<double, 6> springs_of(const LumpedModel &model)
{
  const auto &K = model.K;
  return {K[0].value, K[1].value, K[2].value, K[4].value, K[5].value, K[6].value};
}

dynamics::ModalModel modes_of(const ChatterCase &spec)
{
  const auto s = model_from_files(*spec.files);
  return dynamics::modal_model(s.model, s.modes.frequency, s.modes.shape, spec.modal_damping,
                               2 * spec.files->frequency_limit);
}

ChatterStandModel stand_of(const ChatterCase &spec, const ChatterStand &stand)
{
  ChatterStandModel model;
  const bool own_dampers = !std::isnan(stand.dampings[0]);
  if (spec.files)
    model.structure = dynamics::structure_of(modes_of(spec));
  else if (spec.model && !own_dampers)
    model.structure = chain_structure(*spec.model, chain_settings(spec.modal_damping, FrameForm::open));
  else if (spec.model)
    model.structure =
        dynamics::six_mass_structure(masses_of(*spec.model), springs_of(*spec.model), stand.dampings);
  else
    model.structure = dynamics::six_mass_structure(stand.masses, stand.stiffnesses, stand.dampings);
  model.entry_distance = stand.entry_distance;
  model.exit_distance  = stand.exit_distance;
  model.strip_modulus  = spec.strip.youngs_modulus;
  return model;
}

std::vector<dynamics::StructureNumber> numbers_of(const ChatterCase &spec)
{
  if (spec.files)
    return dynamics::modal_numbers(modes_of(spec));
  if (!spec.model)
    return dynamics::six_mass_numbers(spec.stand.masses, spec.stand.stiffnesses, spec.stand.dampings);
  if (!std::isnan(spec.stand.dampings[0]))
    return dynamics::six_mass_numbers(masses_of(*spec.model), springs_of(*spec.model), spec.stand.dampings);
  return dynamics::chain_numbers(*spec.model, chain_settings(spec.modal_damping, FrameForm::open));
}

}  // namespace

ChatterQuestion chatter_question(const ChatterCase &spec, const std::size_t condition, MovingKeys *const keys)
{
  const ChatterStandModel stand = stand_of(spec, spec.stand);
  ChatterQuestion q;
  q.condition  = spec.conditions[condition];
  q.label      = "condition " + q.condition.name;
  q.bite       = bite_of(spec, q.condition);
  q.stand      = stand;
  q.structure  = spec.files   ? "model " + spec.files->name + " of " + spec.stand.from
                 : spec.model ? "six masses of " + spec.stand.from
                              : "six masses as given";
  q.scheme     = spec.analysis.linearisation;
  q.analysis   = spec.analysis;
  q.film_range = spec.film_range;
  for (const ChatterVariant &variant : spec.variants)
    q.variants.push_back({variant.name, stand_of(spec, completed(variant, spec.stand))});
  q.structures = {{spec.files ? spec.files->name : "six masses", stand}};
  q.numbers    = numbers_of(spec);
  if (!keys)
    return q;
  q.inputs    = chatter_keys(*keys, condition, ChatterReading::all);
  q.inputs_of = [keys, condition](const ChatterReading reading, const ResultRow &) {
    return chatter_keys(*keys, condition, reading);
  };
  for (std::size_t v = 0; v < q.variants.size(); ++v)
    q.variants[v].inputs = variant_keys(*keys, condition, v);
  return q;
}

RollingCondition condition_of(const Pass &pass, const Strip &strip)
{
  RollingCondition c;
  c.name            = pass.name;
  c.place           = pass.place;
  c.entry_thickness = strip.entry_thickness;
  c.exit_thickness  = strip.exit_thickness;
  c.entry_tension   = strip.entry_tension;
  c.exit_tension    = strip.exit_tension;
  c.width           = strip.width;
  c.speed           = pass.speed;
  return c;
}

StandQuestion chatter_question(const FourHigh &stand, const Pass &pass, const reduce::LumpedStand &chain,
                               const StandModels &models)
{
  StandQuestion asked;
  ChatterQuestion &q  = asked.question;
  q.bite              = mill::bite_of(stand.strip, pass, stand.work_roll.barrel_diameter, stand.steel);
  const Strip &strip  = q.bite.strip;
  RollingCondition &c = q.condition;
  c                   = condition_of(pass, strip);
  q.label             = pass.name;
  q.analysis          = stand.analysis;
  q.scheme            = stand.analysis.linearisation;
  if (std::isnan(c.speed)) {
    q.speed_assumed = true;
    c.speed         = 0.5 * (stand.analysis.speeds[0] + stand.analysis.speeds[1]);
    asked.assumed.push_back(fmt::format("{}: the speed of the rolls is not given (pass.speed); {:.4g} m/s is "
                                        "used, the middle of the range searched",
                                        pass.name, c.speed));
  }
  const FreeStrip free = free_strip(stand);
  asked.assumed.insert(asked.assumed.end(), free.assumed.begin(), free.assumed.end());
  const auto around = [&](dynamics::StandStructure structure) {
    return ChatterStandModel{std::move(structure), free.entry_distance, free.exit_distance, strip.youngs_modulus};
  };
  const auto settings = chain_settings(stand.dynamics.modal_damping, stand.dynamics.frame);
  const auto modal    = [&](const reduce::StandWithModes &model) {
    return dynamics::modal_model(model.model, model.modes.frequency, model.modes.shape, settings.modal_damping,
                                    2 * stand.dynamics.frequency_limit);
  };
  const auto beam = modal(models.beam), craig_bampton = modal(models.craig_bampton);
  q.structures = {
      {"craig-bampton", around(dynamics::structure_of(craig_bampton)), dynamics::modal_numbers(craig_bampton)},
      {"beam", around(dynamics::structure_of(beam)), dynamics::modal_numbers(beam)},
      {"six-mass", around(chain_structure(chain.model, settings)),
       dynamics::chain_numbers(chain.model, settings)}};
  q.structure     = fmt::format("modal damping {:g} %", 100 * stand.dynamics.modal_damping);
  const auto p    = std::size_t(std::find_if(stand.passes.begin(), stand.passes.end(),
                                             [&](const Pass &one) { return one.name == pass.name; }) -
                                stand.passes.begin());
  const auto keys = std::make_shared<MovingKeys>(stand);
  const KeyList vibrates =
      joined(detailed_model_keys(*keys), chain_mode_keys(*keys, chain.model, settings, Half::upper),
             chain_mode_keys(*keys, chain.model, settings, Half::lower));
  q.inputs    = joined(stand_search_keys(*keys, p, ChatterReading::all), vibrates);
  q.inputs_of = [keys, p, vibrates](const ChatterReading reading, const ResultRow &row) {
    if (reading == ChatterReading::bite || reading == ChatterReading::slopes)
      return pass_bite_keys(*keys, p, reading, row);
    return joined(stand_search_keys(*keys, p, reading), vibrates);
  };
  return asked;
}
}  // namespace mill
