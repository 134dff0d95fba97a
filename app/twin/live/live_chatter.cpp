#include "app/twin/live/live_chatter.h"
#include "app/chatter/chatter_question.h"
#include "app/twin/stand/chatter_model.h"
#include "core/base/errors.h"
#include "core/model/case.h"
#include "dynamics/chatter/chatter.h"
#include "dynamics/chatter/sensitivity.h"
#include "dynamics/response/modal_model.h"
#include "reduce/stand/stand_modes.h"
#include <fmt/format.h>

namespace mill {
namespace {
// Adopted springs and their modal damping, in place of the values of the case.
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
  chatter.setup.model = chatter_model(question);
  if (spec.conditions.size() > 1)
    chatter.notes.push_back(fmt::format(
        "the critical speed is that of {}, the first of {} conditions; tensions and thicknesses of the "
        "stream replace its values",
        question.label, spec.conditions.size()));
  return chatter;
}

// The detailed stand without the spring and the damper of the strip: the bite is what chatter adds.
dynamics::ModalModel open_modes(const live::TwinModel &model)
{
  const live::DetailedTwin &detail = *model.detailed;
  const StandModel open            = reduce::without(live::with_springs(detail.stand, detail, model.chain), "K4");
  const auto modes                 = reduce::stand_modes(open);
  return dynamics::modal_model(open, modes.frequency, modes.shape, model.dynamics.modal_damping, detail.highest);
}

LiveChatter of_pass(const FourHigh &stand, const live::TwinModel &model)
{
  LiveChatter chatter;
  const FreeStrip strip = free_strip(stand);
  chatter.setup.model =
      chatter_model(stand, stand.passes.front(), model.six_masses.value_or(model.chain), model.dynamics, strip);
  if (model.detailed) {
    const dynamics::ModalModel modes    = open_modes(model);
    chatter.setup.model.stand.structure = dynamics::structure_of(modes);
    chatter.setup.model.numbers         = dynamics::modal_numbers(modes);
  }
  chatter.notes = strip.assumed;
  return chatter;
}
}  // namespace

std::vector<live::WatchedBand> watched_bands(const Monitoring &monitoring)
{
  auto bands       = live::bands_over("third octave", monitoring.third_octave[0], monitoring.third_octave[1]);
  const auto fifth = live::bands_over("fifth octave", monitoring.fifth_octave[0], monitoring.fifth_octave[1]);
  bands.insert(bands.end(), fifth.begin(), fifth.end());
  return bands;
}

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
  return chatter;
}
}  // namespace mill
