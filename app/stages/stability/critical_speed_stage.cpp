#include "app/stages/stability/critical_speed_stage.h"
#include "app/stages/bite/bite_stage.h"
#include "app/stages/bite/free_strip.h"
#include "app/stages/stability/stability_question.h"
#include "app/stages/stability/uncertain_numbers.h"
#include "app/stages/stand/mode_results.h"
#include "core/case/chatter_inputs.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/model/case.h"
#include "core/model/four_high.h"
#include "dynamics/response/mill_model.h"
#include "reduce/stand/component_stand.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// Without K4 in the chain: the bite is what chatter adds.
FourHigh open_stand(FourHigh stand)
{
  stand.dynamics.force_meaning = ForceMeaning::measured;
  return stand;
}

bool holds_strip(const FourHigh &stand)
{
  return stand.dynamics.force_meaning != ForceMeaning::measured;
}

KeyList keys_of_search(const FourHigh &stand, const std::size_t p, const reduce::LumpedStand &chain)
{
  MovingKeys keys(stand);
  return joined(stand_search_keys(keys, p, ChatterReading::all), keys_of_models(keys, chain),
                chain.model.Kzc[1].inputs, chain.model.Kzc[2].inputs);
}
}  // namespace

std::vector<std::string> missing_for_critical_speed(const Case &the_case, const FourHigh &stand,
                                                    const std::size_t pass)
{
  std::vector<std::string> missing;
  if (std::isnan(stand.passes[pass].speed))
    missing.push_back(fmt::format("pass.{}.speed", pass));
  for (const char *tension : {"entry_tension", "exit_tension"})
    if (!the_case.places.count(fmt::format("pass.{}.{}", pass, tension)) &&
        !the_case.places.count(std::string("strip.") + tension))
      missing.push_back(std::string("strip.") + tension);
  for (const std::string &key : keys_missing_of_bite(the_case))
    missing.push_back(key);
  return missing;
}

reduce::StandWithModes without_strip(const FourHigh &stand, const reduce::LumpedStand &chain,
                                     const StandModels &models, const ComponentSets &components)
{
  if (!holds_strip(stand))
    return models.craig_bampton;
  const FourHigh open = open_stand(stand);
  reduce::StandWithModes s{
      reduce::component_stand(open, reduce::stand_springs(open, chain, true), components.fine), {}};
  s.modes = reduce::stand_modes(s.model, 2 * open.dynamics.frequency_limit);
  return s;
}

void add_critical_speed(RunContext &run, const FourHigh &stand, const std::size_t p,
                        const reduce::LumpedStand &chain, const StandModels &models,
                        const ComponentSets &components)
{
  const Pass &pass = stand.passes[p];
  if (const auto missing = missing_for_critical_speed(run.the_case, stand, p); !missing.empty()) {
    run.results.speeds.push_back(not_searched(pass.name, pass.speed, missing));
    return;
  }
  const FourHigh open = open_stand(stand);
  StandModels open_models;
  open_models.craig_bampton           = without_strip(stand, chain, models, components);
  const reduce::StandWithModes &solid = open_models.craig_bampton;
  const double damping                = stand.dynamics.modal_damping;
  const auto modes     = dynamics::modal_model(solid.model, solid.modes.frequency, solid.modes.shape, damping,
                                               2 * stand.dynamics.frequency_limit);
  const FreeStrip free = free_strip(stand);
  StabilityQuestion q;
  q.pass                  = pass.name;
  q.speed                 = pass.speed;
  q.K4                    = knows_strip(chain.model) ? chain.model.K[3].value : not_given;
  q.model                 = title_of(solid.model.name);
  q.leading.bite          = bite_of(stand.strip, pass, stand.work_roll.barrel_diameter, stand.steel);
  q.leading.modal_damping = damping;
  q.leading.scheme        = stand.analysis.linearisation;
  q.leading.range         = speed_range(stand.analysis);
  const auto around       = [&](dynamics::StandStructure structure) {
    return dynamics::ChatterStandModel{std::move(structure), free.entry_distance, free.exit_distance,
                                       q.leading.bite.strip.youngs_modulus};
  };
  q.leading.stand = around(dynamics::structure_of(modes));
  q.others = {{"six masses", around(dynamics::structure_of(dynamics::mill_model(chain.model, open.dynamics)))}};
  UncertainNumbers uncertain =
      uncertain_numbers(fitted_errors(run), stand, q.leading.bite,
                        inputs_of_modes(open, chain, open_models, components), modes.frequency.size());
  q.uncertain = std::move(uncertain.numbers);
  q.assumed   = std::move(uncertain.assumed);
  q.inputs    = keys_of_search(stand, p, chain);
  for (const std::string &sentence : free.assumed)
    run.assume(sentence);
  add_critical_speed(run, q);
}
}  // namespace mill
