#include "app/kinds/mark_sources.h"
#include "app/stages/response/turning_rolls.h"
#include "core/model/bite_case.h"
#include "core/model/chatter.h"
#include "core/model/four_high.h"
#include "core/model/lumped.h"

namespace mill {
namespace {
// Rolls by their diameter; every event of a turn once, since marks ask for multiples themselves.
dynamics::MarkSources sources_of(const std::vector<TurningRoll> &rolls, const std::vector<Pass> &passes,
                                 const std::vector<DriveOrder> &drive, const double damping)
{
  dynamics::MarkSources sources;
  for (const TurningRoll &roll : rolls)
    sources.rolls.push_back({word_of(roll.kind), roll.diameter, roll.diameter_key});
  CampbellSettings once;
  once.roll_orders       = 0;
  once.bearing_harmonics = 1;
  sources.events         = turning_lines(once, {nullptr, rolls, passes, drive}).lines;
  sources.damping        = damping;
  return sources;
}
}  // namespace

dynamics::MarkSources mark_sources(const FourHigh &stand)
{
  return sources_of(turning_rolls(stand), stand.passes, stand.drive, stand.dynamics.modal_damping);
}

dynamics::MarkSources mark_sources(const Lumped &lumped)
{
  return sources_of(turning_rolls(lumped), lumped.passes, lumped.drive, lumped.dynamics.modal_damping);
}

dynamics::MarkSources mark_sources(const BiteCase &spec)
{
  dynamics::MarkSources sources;
  sources.rolls = {{"work roll", spec.roll_diameter, "work_roll.diameter"}};
  return sources;
}

dynamics::MarkSources mark_sources(const ChatterCase &spec)
{
  dynamics::MarkSources sources;
  sources.rolls   = {{"work roll", spec.roll_diameter, "work_roll.diameter"}};
  sources.damping = spec.modal_damping;
  return sources;
}
}  // namespace mill
