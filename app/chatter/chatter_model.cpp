#include "app/chatter/chatter_model.h"
#include "app/stages/bite_stage.h"
#include "app/stages/chatter_question.h"
#include "core/model/case.h"
#include "dynamics/response/mill_model.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double usual_distance = 5;  // m
}  // namespace

std::string missing_of_bite(const Case &the_case)
{
  std::string missing;
  for (const char *key :
       {"strip.entry_thickness", "strip.exit_thickness", "strip.friction", "strip.flow_stress"}) {
    const bool is_there = std::any_of(the_case.places.begin(), the_case.places.end(), [&](const auto &entry) {
      return entry.first == key || entry.first.rfind(std::string(key) + ".", 0) == 0;
    });
    if (!is_there)
      missing += (missing.empty() ? "" : ", ") + std::string(key);
  }
  return missing;
}

FreeStrip free_strip(const FourHigh &stand)
{
  FreeStrip strip;
  const auto distance = [&](const double given, const char *key) {
    if (!std::isnan(given))
      return given;
    strip.assumed.push_back(
        fmt::format("stand.{} is not given: {:g} m of free strip are assumed", key, usual_distance));
    return usual_distance;
  };
  strip.entry_distance = distance(stand.span.entry_distance, "entry_distance");
  strip.exit_distance  = distance(stand.span.exit_distance, "exit_distance");
  return strip;
}

dynamics::SpeedRange chatter_range(const ChatterAnalysis &analysis)
{
  ChatterQuestion question;
  question.analysis = analysis;
  return chatter_range(question);
}

twin::ChatterModel chatter_model(const ChatterQuestion &question)
{
  return {question.stand, question.bite, question.scheme, chatter_range(question), question.numbers};
}

DynamicsSettings without_strip(DynamicsSettings settings)
{
  settings.force_meaning = "measured";
  return settings;
}

twin::ChatterModel chatter_model(const FourHigh &stand, const Pass &pass, const LumpedModel &chain,
                                 const DynamicsSettings &settings, const FreeStrip &strip)
{
  const DynamicsSettings open = without_strip(settings);
  twin::ChatterModel model;
  model.bite    = bite_of(stand.strip, pass, stand.work_roll.barrel_diameter, stand.steel);
  model.stand   = {dynamics::structure_of(dynamics::mill_model(chain, open)), strip.entry_distance,
                   strip.exit_distance, model.bite.strip.youngs_modulus};
  model.scheme  = linearisation_of(stand.analysis);
  model.range   = chatter_range(stand.analysis);
  model.numbers = dynamics::chain_numbers(chain, open);
  return model;
}
}  // namespace mill
