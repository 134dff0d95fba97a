#pragma once
#include <memory>

namespace mill {
struct Stack;
struct StackInput;

/// kind = "stack": rolls that bend and flatten, with the strip between them.  What it holds stands in
/// core/model/stack_input.h and core/model/stack.h, behind pointers, as for a cluster.
struct StackCase {
  std::shared_ptr<const StackInput> input;  ///< as written; never null in a case that was read
  std::shared_ptr<const Stack> stack;       ///< resolved: every roll placed; never null in a case that was read
};
}  // namespace mill
