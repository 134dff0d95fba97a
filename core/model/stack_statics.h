#pragma once
#include "core/model/stack.h"

namespace mill {
/// What the contacts of a stack have to carry whatever its elasticity.
struct StackResultant {
  double force  = 0;  ///< N, below zero: the rolls would have to pull at each other
  double centre = 0;  ///< m, z of the resultant, mill frame
};

/// Of every contact, from the angles alone: a roll leans on one or two others, whose forces follow from its
/// balance of forces and moments.  theory.md (51.11)
/// @param force  N, of the strip
std::vector<StackResultant> stack_resultants(const Stack &stack, double force);
}  // namespace mill
