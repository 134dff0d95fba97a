#pragma once
#include "app/stack/stack_stage.h"

// What the figures of a stack are drawn from.
namespace mill {
/// Profile of the strip, line loads, rolls, influence shapes, and curves/stack.json with the section.
void write_stack_curves(const RunContext &run, const StackInput &input, const SolvedStack &solved);

/// Modulus over the rolling force, and the maps of [window], by beams on their coarser mesh.
/// Cost: some 10 states, and points^2 for each map.
void write_stack_maps(RunContext &run, const StackInput &input, const Stack &stack);

std::string pair_name(const Stack &stack, const StackContact &contact);  ///< "W-B"
}  // namespace mill
