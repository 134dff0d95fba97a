#pragma once
#include "core/case/fields.h"
#include "core/model/stack_input.h"

namespace mill {
/// Rolls of one half of a stack, places in StackInput::rolls.
struct StackHalf {
  std::vector<std::size_t> rolls;                 ///< each after all that lean on it: the roll at the strip first
  std::vector<std::vector<std::size_t>> parents;  ///< of every roll of the input, those that it leans on
  std::vector<std::array<double, 2>> axes;        ///< m, of every roll of the input
};

/// The halves of the listed rolls: one, or with lower = "listed" two, the upper one first.  Empty with problems in
/// `reading`: unknown, doubled or cyclic `on`, not one roll of each half at the strip, rolls that cannot be
/// placed.
std::vector<StackHalf> placed_halves(const StackInput &input, Reading &reading);

std::string roll_key(std::size_t roll, const char *key);  ///< "roll.2.on"
}  // namespace mill
