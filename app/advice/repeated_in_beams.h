#pragma once
#include "app/advice/advised_model.h"
#include <vector>

namespace mill {
/// Every action of a chain tried again with rolls as beams, its dampers at mid-length of the rolls and on their
/// chocks; what counts is then the change with dampers on the chocks, and actions are ranked by it.  What cannot
/// be repeated (K2, K6, which are several parts of a drawing; a case without one) stays marked "chain only" where
/// it has dampers. Cost: 0.1 s for each stand with changed springs, 20 ms for each damper, 0.2 s for each tuned
/// one.
void repeat_in_beams(std::vector<twin::RatedAction> &actions, const AdvisedModel &model, int place,
                     const twin::ForceBand &force);
}  // namespace mill
