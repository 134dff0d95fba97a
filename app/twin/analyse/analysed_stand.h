#pragma once
#include "core/model/monitoring.h"
#include "twin/analysis/analysis.h"

namespace mill {
struct Case;

/// What the case of a record says of its stand: modes with shares, rolls, bearings.  Kind lumped as given; kind
/// four-high with rolls as beams and all else by closed forms at the load of its first pass (theory.md 22, 24),
/// since a record is analysed in seconds.
/// @param six_masses  of kind four-high: the chain instead, with a warning where it puts modes of the gap wrongly
/// @throws InputError  a kind without a stand that vibrates, a stand in files
/// Cost: 0.1 s for the beams.
twin::CaseModel analysed_stand(const Case &the_case, bool six_masses);

/// Adds the ball bearings of [monitoring] to those of the case; one at a roll without a diameter becomes a note.
void add_ball_bearings(twin::CaseModel &stand, const std::vector<BallBearing> &bearings);
}  // namespace mill
