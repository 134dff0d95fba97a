#pragma once
#include "core/model/stack.h"
#include "reduce/stack/moving_stack.h"
#include "reduce/stack/stack_state.h"
#include "reduce/stand/gap_modes.h"
#include "reduce/stand/stand_modes.h"
#include <vector>

namespace mill::reduce {
/// Every mode of a stack in the terms of the rules for names.  What carries a work roll is the mean of its
/// neighbours, which the vertical part of what their contacts carry weighs; parts are the rolls by direction, and
/// by translation, tilting and bending.  theory.md 22.9
/// @param moving  with `modes`, of its model with or without strip
std::vector<GapMotion> gap_motions(const Stack &stack, const StackState &state, const MovingStack &moving,
                                   const StandModel &model, const StandModes &modes);
}  // namespace mill::reduce
