#pragma once
#include "twin/live/engine/twin_model.h"
#include "twin/live/page/event_text.h"

namespace mill {
/// What would lower the level of a place in the twin as it now stands, by the chain alone: springs, dampers
/// between the rolls and a tuned damper under a white force to 1 kHz.  theory.md 46
/// @param place  "upper_work_roll"; one that the stand has not is answered for the upper work roll
/// Cost: some 0.15 s.  Does not throw: a stand without an answer says why in the text.
live::PageAdvice live_advice(const live::TwinModel &model, const live::Tuning &tuning, const std::string &place,
                             double utc);
}  // namespace mill
