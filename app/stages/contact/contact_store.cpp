#include "app/stages/contact/contact_store.h"
#include "app/stages/contact/contact_stage.h"
#include "core/case/contact_inputs.h"
#include "core/model/four_high.h"
#include "core/records/record_text.h"
#include <utility>

namespace mill {
namespace {
// Raised by hand when the solution of a contact changes what it computes.
constexpr const char *contact_stage_version = "contact 3";
}  // namespace

std::string contact_inputs(const FourHigh &stand, const std::string &name, const ContactSettings &settings,
                           const std::vector<double> &loads)
{
  const auto range       = swept_range(name, settings, loads);
  const PlannedPair plan = planned_rolls(stand, settings, range[1], first_reach);
  std::string rolls;
  for (const PlannedRoll *roll : {&plan.backup, &plan.work})
    for (const bool companion : {false, true})
      rolls += roll_inputs(roll->geometry, roll->size, stand.steel, plan.wanted, companion);
  return record_text(contact_stage_version, name, rolls, inputs_of_pair(stand, settings), loads);
}
}  // namespace mill
