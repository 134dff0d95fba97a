#pragma once
#include "app/advice/advised_model.h"
#include <vector>

namespace mill {
/// The dampers of every action of a chain tried again with rolls as beams, at mid-length of the rolls and on their
/// chocks; what is not repeated stays marked "chain only".  Actions with a changed spring are not repeated, since
/// a spring of the chain is many parts of a drawing. Cost: 20 ms for each damper, 0.3 s for each tuned one with 10
/// 000 frequencies.
void repeat_in_beams(std::vector<twin::RatedAction> &actions, const AdvisedModel &model, int place,
                     const twin::ForceBand &force);
}  // namespace mill
