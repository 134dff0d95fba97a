#pragma once
#include "core/case/fields.h"
#include "core/model/stack_input.h"
#include <string>

namespace mill {
/// Is the key written in the case, and not a default?
inline bool is_in_case(const Reading &reading, const std::string &key)
{
  return reading.places.count(key) > 0;
}

/// Contradictions of the rolls of a stack: names, tables, shafts, bearings, saddles, materials.
/// @param root  of the file, for its bearings
void check_stack_rolls(const StackInput &input, const Node &root, Reading &reading);
}  // namespace mill
