#pragma once
#include "reduce/bite/bite.h"

namespace mill::bite {
/// Neutral position and thickness of a state from its slip along the arc: where the slip changes its sign, found
/// and not prescribed; of several changes (a zone without slip) the middle.  Both nan where there is none.
/// @param least  -, slip below it is taken as zero, so that rounding in a zone without slip is not a neutral point
/// @return changes of sign
int find_neutral_point(BiteState &state, double least);

/// Angle at the axis of the roll between the line of centres and the neutral point, asin(x_n/R) with the roll's
/// own radius R: the flattened arc is a shape of the surface, the roll still turns about its axis.  rad, positive
/// towards the entry; nan without a neutral point.
double neutral_angle(const RollBite &bite, const BiteState &state);
}  // namespace mill::bite
