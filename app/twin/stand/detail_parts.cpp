#include "app/twin/stand/detail_parts.h"
#include "app/stages/stand/headline.h"
#include "app/stages/stand/mode_results.h"
#include "app/stages/stand/modulus_stage.h"
#include "app/trace/closed_form_chain.h"
#include "app/trace/closed_form_parts.h"
#include "core/model/case.h"
#include "reduce/chain/frame_closure.h"
#include "reduce/stand/stand_modes.h"
#include <cmath>

namespace mill {
double gap_damper_of(const LumpedModel &chain, const DynamicsSettings &settings)
{
  return settings.force_meaning == ForceMeaning::measured || std::isnan(chain.C.value) ? 0 : chain.C.value;
}

DetailParts detail_parts(const FourHigh &drawn, const CaseChain &chain)
{
  DetailParts parts{with_drawn_frame(drawn), {}, gap_damper_of(chain.model, chain.dynamics)};
  reduce::ChainInputs inputs;
  reduce::each_spring(
      [&](const std::string &name, Parameter &spring) {
        if (const ClosedFormResult *result = find(chain.results, name))
          spring = result->parameter;
      },
      inputs);
  inputs.K_ww       = touching_work_rolls(parts.stand, chain.load, nullptr);
  parts.stand.frame = reduce::frame_on_modulus(parts.stand, inputs);
  // Chocks of the work rolls on their bearings: these are the modes that six masses lack.
  parts.springs = reduce::stand_springs(
      parts.stand, reduce::lumped_stand(parts.stand, inputs, reduce::StatedErrors::none), true);
  return parts;
}

reduce::StandWithModes closed_form_beams(const FourHigh &drawn, const CaseChain &chain)
{
  const DetailParts parts = detail_parts(drawn, chain);
  reduce::StandWithModes beams{reduce::beam_stand(parts.stand, parts.springs), {}};
  beams.modes = reduce::stand_modes(beams.model, 2 * chain.dynamics.frequency_limit);
  return beams;
}

std::optional<Warning> warning_of_six_masses(const Case &the_case, const std::string &verb)
{
  const auto *drawn = std::get_if<FourHigh>(&the_case.spec);
  if (!drawn)
    return {};
  const CaseChain chain = case_chain(the_case, verb);
  return six_mass_gap_error(closed_form_beams(*drawn, chain), chain_with_modes(chain.model, chain.dynamics),
                            chain.dynamics.frequency_limit);
}
}  // namespace mill
