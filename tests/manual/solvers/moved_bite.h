#pragma once
#include "reduce/bite/bite.h"

namespace mill::bite {
/// The bite with one input moved, each by the unit of its derivative: what a difference quotient needs.  Friction:
/// every number of the law that represents a level of friction; arc radius: that of the roll.
RollBite moved_bite(RollBite bite, Input input, double by);
}  // namespace mill::bite
