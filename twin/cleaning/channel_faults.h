#pragma once
#include "twin/cleaning/event_list.h"

// The faults of one channel, each found and treated separately.
namespace mill::twin {
/// Levels at which a channel is held: an extreme (to 1e-6 of the range) that three neighbours or more than 0.1 %
/// of the samples have.  Fills clip_low, clip_high, clipped, clipped_share; values are not changed.
/// @param value  (m) as recorded, NaN where nothing is
/// @param at     s, of a sample by its index
void find_clipping(CleanChannel &channel, const Eigen::VectorXd &value, double rate, EventList &events);

/// Cuts pieces in which the value stays the same for 5 ms and 50 samples, except at a clip level.
void cut_stuck(CleanChannel &channel, double rate, EventList &events);

/// Takes the line through all pieces off.
void take_off_drift(CleanChannel &channel, double rate);
}  // namespace mill::twin
