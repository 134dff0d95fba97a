#pragma once
#include "app/twin/advice/advised_model.h"
#include <optional>
#include <vector>

namespace mill {
/// Every action of a chain tried again in the detailed stand, its dampers at mid-length of the rolls and on their
/// chocks; what counts is then the change with dampers on the chocks, and actions are ranked by it; so is the
/// critical speed.  What cannot be repeated (K2, K6, which are several parts of a drawing; a case without one)
/// stays marked "chain only" where it has dampers. Cost with beams: 0.1 s for each stand with changed springs, 20
/// ms for each damper, 0.2 s for each tuned one, 0.3 s for each critical speed.
/// @returns the pass as it is in the detailed stand, where there are both
std::optional<twin::CriticalState> repeat_in_detail(std::vector<twin::RatedAction> &actions,
                                                    const AdvisedModel &model, int place,
                                                    const twin::ForceBand &force);
}  // namespace mill
