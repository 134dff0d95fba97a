#pragma once
#include "core/model/stack.h"
#include "core/model/stack_input.h"

namespace mill {
/// The roll of the lower half that is made of a listed one.
inline bool is_made_of(const StackRoll &roll, const StackRollInput &written)
{
  return roll.made_of == written.name;
}
}  // namespace mill
