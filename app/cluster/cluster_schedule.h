#pragma once
#include "app/stages/bite/schedule_forces.h"
#include <optional>

namespace mill {
struct Case;
struct ClusterPass;
struct ClusterStand;

/// The bite of a pass; nothing where the case does not draw it: width, thicknesses, friction.
std::optional<bite::RollBite> bite_of_pass(const ClusterStand &stand, const ClusterPass &pass);

/// Every pass of a case of kind "cluster" whose bite is drawn; without one the list of passes is empty.
ScheduleQuestion schedule_question(const Case &the_case, bool with_models);
}  // namespace mill
