#include "core/case/chatter_inputs.h"
#include "core/case/bite_inputs.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
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

KeyList stand_search_keys(MovingKeys &keys, const std::size_t pass)
{
  BiteReading slab;
  slab.by            = BiteAnswers::compared;
  slab.fitted        = false;
  const KeyList bite = bite_keys(keys, pass, slab);
  return joined(bite, keys.of(fmt::format("search {}", pass), [&](const CaseSpec &spec) {
    const auto &stand = std::get<FourHigh>(spec);
    return record_text(stand.passes[pass].speed, stand.strip.youngs_modulus, stand.span.entry_distance,
                       stand.span.exit_distance, stand.analysis.linearisation, stand.analysis.speeds,
                       stand.dynamics.modal_damping);
  }));
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
