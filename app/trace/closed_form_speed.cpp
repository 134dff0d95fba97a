#include "app/trace/closed_form_speed.h"
#include "app/stages/bite/bite_stage.h"
#include "app/stages/bite/free_strip.h"
#include "app/stages/stability/critical_speed_stage.h"
#include "app/stages/stability/stability_question.h"
#include "app/stages/stability/uncertain_numbers.h"
#include "app/stages/stand/mode_results.h"
#include "app/trace/closed_form_chain.h"
#include "core/model/case.h"
#include "core/model/four_high.h"

namespace mill {
namespace {
StabilityQuestion question_of(const ClosedFormStand &closed, const Pass &pass)
{
  FourHigh open               = *closed.stand;
  open.dynamics.force_meaning = ForceMeaning::measured;  // without K4: the bite is what chatter adds
  const auto chain            = chain_with_modes(closed.model, open.dynamics);
  const double damping        = open.dynamics.modal_damping;
  const auto modes     = dynamics::modal_model(chain.model, chain.modes.frequency, chain.modes.shape, damping,
                                               2 * open.dynamics.frequency_limit);
  const FreeStrip free = free_strip(open);
  StabilityQuestion q;
  q.pass                  = pass.name;
  q.speed                 = pass.speed;
  q.model                 = "six masses by closed forms";
  q.leading.bite          = bite_of(open.strip, pass, open.work_roll.barrel_diameter, open.steel);
  q.leading.modal_damping = damping;
  q.leading.scheme        = open.analysis.linearisation;
  q.leading.range         = speed_range(open.analysis);
  q.leading.stand         = {dynamics::structure_of(modes), free.entry_distance, free.exit_distance,
                             q.leading.bite.strip.youngs_modulus};
  q.uncertain = uncertain_numbers({}, open, q.leading.bite, reduce::modal_sensitivities(chain, closed.model),
                                  modes.frequency.size())
                    .numbers;
  return q;
}
}  // namespace

std::vector<SpeedVerdict> closed_form_speeds(const Case &the_case, const ClosedFormMemory &memory)
{
  std::vector<SpeedVerdict> verdicts;
  for (std::size_t p = 0; p < memory.stands.size(); ++p) {
    const FourHigh &stand = *memory.stands[p].stand;
    const Pass &pass      = stand.passes[p];
    const auto missing    = missing_for_critical_speed(the_case, stand, p);
    verdicts.push_back(missing.empty() ? speed_verdict(question_of(memory.stands[p], pass))
                                       : not_searched(pass.name, pass.speed, missing));
  }
  return verdicts;
}
}  // namespace mill
