#include "app/twin/stand/chatter_model.h"
#include "app/chatter/chatter_question.h"
#include "app/stages/bite/bite_stage.h"
#include "core/model/case.h"
#include "dynamics/response/mill_model.h"

namespace mill {
namespace {
dynamics::SpeedRange chatter_range(const ChatterAnalysis &analysis)
{
  ChatterQuestion question;
  question.analysis = analysis;
  return mill::chatter_range(question);
}

// The chain without the spring and the damper of the strip: the bite is what chatter adds.
DynamicsSettings without_strip(DynamicsSettings settings)
{
  settings.force_meaning = ForceMeaning::measured;
  return settings;
}
}  // namespace

twin::ChatterModel chatter_model(const ChatterQuestion &question)
{
  return {question.stand, question.bite, question.scheme, mill::chatter_range(question), question.numbers};
}

twin::ChatterModel chatter_model(const FourHigh &stand, const Pass &pass, const LumpedModel &chain,
                                 const DynamicsSettings &settings, const FreeStrip &strip)
{
  const DynamicsSettings open = without_strip(settings);
  twin::ChatterModel model;
  model.bite    = bite_of(stand.strip, pass, stand.work_roll.barrel_diameter, stand.steel);
  model.stand   = {dynamics::structure_of(dynamics::mill_model(chain, open)), strip.entry_distance,
                   strip.exit_distance, model.bite.strip.youngs_modulus};
  model.scheme  = stand.analysis.linearisation;
  model.range   = chatter_range(stand.analysis);
  model.numbers = dynamics::chain_numbers(chain, open);
  return model;
}
}  // namespace mill
