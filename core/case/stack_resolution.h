#pragma once
#include "core/case/fields.h"
#include "core/model/stack_input.h"

namespace mill {
/// Places every roll of the input and makes the lower half.  What cannot be (parents too far apart, bodies that
/// overlap, a contact that would have to pull, too little overlap of barrels) becomes a problem of `reading`, at
/// the key that says it.
/// @return  SI, complete only when `reading` has no problem.  Cost: O(rolls^2).  theory.md 51.3
Stack resolved_stack(const StackInput &input, Reading &reading);
}  // namespace mill
