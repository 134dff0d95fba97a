#pragma once
#include "core/model/monitoring.h"
#include "twin/analysis/analysis.h"

namespace mill {
struct Case;

/// What the case of a record says of its stand: modes with shares, rolls, bearings.  Kind lumped as given; kind
/// four-high by closed forms at the load of its first pass (theory.md 24), since a record is analysed in seconds.
/// @throws InputError  a kind without a stand that vibrates, a stand in files
twin::CaseModel analysed_stand(const Case &the_case);

/// Adds the ball bearings of [monitoring] to those of the case; one at a roll without a diameter becomes a note.
void add_ball_bearings(twin::CaseModel &stand, const std::vector<BallBearing> &bearings);
}  // namespace mill
