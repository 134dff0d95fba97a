#include "core/case/chatter_inputs.h"
#include "core/case/bite_inputs.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/laws/friction_law.h"
#include "core/records/record_text.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
std::string text_of_condition(const ChatterCase &spec, const std::size_t i, const ChatterReading reading,
                              const ChatterStand &stand)
{
  const RollingCondition &c = spec.conditions[i];
  Strip strip               = with_laws_as_read(spec.strip);
  strip.youngs_modulus      = not_given;  // of the strip between the stands
  std::string text          = record_text(strip, spec.roll_diameter, at_rest(spec.steel), c.entry_thickness,
                                          c.exit_thickness, c.entry_tension, c.exit_tension, c.width);
  if (reading != ChatterReading::search)
    text += record_text(c.speed);
  if (reading == ChatterReading::bite)
    return text;
  text += record_text(spec.analysis.linearisation);
  if (reading == ChatterReading::slopes)
    return text;
  if (reading != ChatterReading::growth)
    text += record_text(spec.analysis.speeds);
  text += record_text(stand.entry_distance, stand.exit_distance, spec.strip.youngs_modulus, spec.stand.from);
  if (!spec.files)
    text += record_text(stand.dampings);
  return spec.stand.from.empty() ? text + record_text(stand.masses, stand.stiffnesses) : text;
}
}  // namespace

KeyList chatter_keys(MovingKeys &keys, const std::size_t condition, const ChatterReading reading)
{
  return keys.of(fmt::format("condition {} {}", condition, int(reading)), [&](const CaseSpec &spec) {
    const auto &chatter = std::get<ChatterCase>(spec);
    return text_of_condition(chatter, condition, reading, chatter.stand);
  });
}

KeyList variant_keys(MovingKeys &keys, const std::size_t condition, const std::size_t variant)
{
  return keys.of(fmt::format("condition {} on variant {}", condition, variant), [&](const CaseSpec &spec) {
    const auto &chatter = std::get<ChatterCase>(spec);
    return text_of_condition(chatter, condition, ChatterReading::search,
                             completed(chatter.variants[variant], chatter.stand));
  });
}

namespace {
// The bite of a pass as the search solves it: always by one slab theory with Hitchcock's arc, without a fit.
std::string text_of_slab(const FourHigh &stand, const std::size_t pass, const ChatterReading reading,
                         BiteReading slab)
{
  slab.by                     = BiteAnswers::compared;
  slab.fitted                 = false;
  BiteInputs inputs           = inputs_of_bite(stand, pass, slab);
  inputs.arc                  = BiteArc::hitchcock;
  inputs.strip.youngs_modulus = inputs.strip.poisson_ratio = not_given;
  if (reading == ChatterReading::search)
    inputs.speed = not_given;
  else if (std::isnan(stand.passes[pass].speed) && (slab.speed || needs_speed(stand.strip.friction)))
    return record_text(inputs, stand.analysis.speeds);  // the middle of the range is assumed
  return record_text(inputs);
}
}  // namespace

KeyList pass_bite_keys(MovingKeys &keys, const std::size_t pass, const ChatterReading reading,
                       const ResultRow &row)
{
  const BiteReading slab = reading_of(row, BiteAnswers::compared);
  const auto what        = fmt::format("slab bite {} {} {} {}", pass, int(reading), slab.whole_width, slab.speed);
  return keys.of(what, [&](const CaseSpec &spec) {
    const auto &stand = std::get<FourHigh>(spec);
    return text_of_slab(stand, pass, reading, slab) +
           (reading == ChatterReading::slopes ? record_text(stand.analysis.linearisation) : "");
  });
}

KeyList stand_search_keys(MovingKeys &keys, const std::size_t pass, const ChatterReading reading)
{
  BiteReading slab;
  slab.speed = reading != ChatterReading::search;
  return keys.of(fmt::format("search {} {}", pass, int(reading)), [&](const CaseSpec &spec) {
    const auto &stand = std::get<FourHigh>(spec);
    std::string text  = text_of_slab(stand, pass, reading, slab);
    if (reading != ChatterReading::growth)
      text += record_text(stand.analysis.speeds);
    return text + record_text(stand.strip.youngs_modulus, stand.span.entry_distance, stand.span.exit_distance,
                              stand.analysis.linearisation, stand.dynamics.modal_damping);
  });
}

ChatterStand completed(const ChatterVariant &variant, const ChatterStand &stand)
{
  ChatterStand all = variant.stand;
  const auto take  = [&](auto ChatterStand::*member) {
    if (std::isnan((all.*member)[0]))
      all.*member = stand.*member;
  };
  take(&ChatterStand::masses);
  take(&ChatterStand::stiffnesses);
  take(&ChatterStand::dampings);
  all.entry_distance = std::isnan(all.entry_distance) ? stand.entry_distance : all.entry_distance;
  all.exit_distance  = std::isnan(all.exit_distance) ? stand.exit_distance : all.exit_distance;
  return all;
}
}  // namespace mill
