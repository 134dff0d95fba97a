#pragma once
#include "app/stack/stack_motion.h"

namespace mill {
/// The verb chatter of a roll stack: every pass that says enough, on its rolls as beams and as one mass each.
/// @throws InputError  none does: which keys the first one lacks
void solve_stack_chatter(RunContext &run, const StackInput &input, const std::vector<MovingPass> &passes);
}  // namespace mill
