#pragma once
#include <string>

namespace mill {
struct Case;

/// A case of kind "four-high" as the text of a case of kind "stack": its rolls with their profiles, bending and
/// shift, its chocks, the strip and the passes.  Bearings have the stiffness of all springs of the chain between
/// their middle and the ground, half for each side, and the strip has the plastic slope of its bite, both by the
/// closed forms of a trace (theory.md 24).  The rolling force is that of the first pass.
/// @throws InputError  another kind; a chain or a bite without closed forms
/// Cost: that of a trace, below 50 ms; a force record is read.
std::string four_high_as_stack(const Case &four_high);
}  // namespace mill
