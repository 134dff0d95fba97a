#include "app/live/live_chatter.h"
#include "app/stages/bite_stage.h"
#include "app/stages/chatter_question.h"
#include "core/case/errors.h"
#include "core/model/case.h"
#include "dynamics/chatter/chatter.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double usual_distance = 5;  // m, as `millstand chatter` takes it

std::vector<live::WatchedBand> chatter_bands()
{
  auto bands       = live::bands_over("third octave", 125, 240);
  const auto fifth = live::bands_over("fifth octave", 550, 650);
  bands.insert(bands.end(), fifth.begin(), fifth.end());
  return bands;
}

// Springs that were adopted beside the mill, and their damping in modes, in place of what the case gives.
ChatterCase with_adopted(ChatterCase spec, const live::TwinModel &model)
{
  if (model.adopted.empty())
    return spec;
  spec.model         = model.chain;
  spec.modal_damping = model.dynamics.modal_damping;
  spec.stand.dampings.fill(not_given);
  return spec;
}

LiveChatter of_condition(const ChatterCase &spec)
{
  const ChatterQuestion question = chatter_question(spec, 0);
  LiveChatter chatter;
  chatter.setup.model = {
      question.stand,
      question.bite,
      question.scheme,
      {question.analysis.speeds[0], question.analysis.speeds[1]},
      question.numbers
  };
  if (spec.conditions.size() > 1)
    chatter.notes.push_back(
        fmt::format("the critical speed is that of {}, the first of {}; tensions and thicknesses "
                    "of the stream take the place of its own",
                    question.label, spec.conditions.size()));
  return chatter;
}

LiveChatter of_pass(const FourHigh &stand, const live::TwinModel &model)
{
  LiveChatter chatter;
  twin::ChatterModel &watched = chatter.setup.model;
  const auto distance         = [&](const double given, const char *key) {
    if (!std::isnan(given))
      return given;
    chatter.notes.push_back(fmt::format("stand.{} is not given: {:g} m of free strip are assumed for the critical "
                                                        "speed",
                                                key, usual_distance));
    return usual_distance;
  };
  DynamicsSettings settings = model.dynamics;
  settings.force_meaning    = "measured";  // the bite is what chatter adds
  watched.bite    = bite_of(stand.strip, stand.passes.front(), stand.work_roll.barrel_diameter, stand.steel);
  watched.stand   = {dynamics::structure_of(dynamics::mill_model(model.chain, settings)),
                     distance(stand.span.entry_distance, "entry_distance"),
                     distance(stand.span.exit_distance, "exit_distance"), watched.bite.strip.youngs_modulus};
  watched.scheme  = linearisation_of(stand.analysis);
  watched.range   = {stand.analysis.speeds[0], stand.analysis.speeds[1]};
  watched.numbers = dynamics::chain_numbers(model.chain, settings);
  return chatter;
}
}  // namespace

std::optional<LiveChatter> live_chatter(const Case &the_case, const live::TwinModel &model)
{
  std::optional<LiveChatter> chatter;
  if (const auto *spec = std::get_if<ChatterCase>(&the_case.spec))
    chatter = of_condition(with_adopted(*spec, model));
  else if (const auto *stand = std::get_if<FourHigh>(&the_case.spec); stand && !stand->passes.empty()) {
    try {
      chatter                     = of_pass(*stand, model);
      const twin::ChatterModel &m = chatter->setup.model;
      (void)dynamics::working_point(m.bite, 0.5 * (m.range.from + m.range.to), m.scheme);
    } catch (const InputError &) {  // the case says too little of its strip, as most that only vibrate
      return {};
    } catch (
        const SolverError &) {  // no steady bite in the middle of the range; a search finds where there is one
    }
  }
  if (chatter)
    chatter->bands = chatter_bands();
  return chatter;
}
}  // namespace mill
