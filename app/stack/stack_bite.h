#pragma once
#include "core/model/pass.h"
#include "core/model/stack.h"
#include "core/model/stack_input.h"
#include "reduce/bite/bite.h"
#include <string>

// The bite between the work rolls of a stack.
namespace mill {
/// The bite of a pass, with a flow stress.
struct StackBite {
  bite::RollBite bite;
  std::string stress;  ///< "310 MPa, fitted to the rolling force": where its flow stress comes from
};
/// @param pass   what it gives replaces that of [strip]
/// @param force  N, to which a flow stress that is not given is fitted
/// @throws InputError, SolverError  what the slab theory refuses
StackBite stack_bite(const StackInput &input, const Stack &stack, const Pass &pass, double force);

/// Keys that the bite of pass p (from 0) lacks, with commas: "strip.friction, pass.0.speed"; empty: all are given.
std::string missing_of_bite(const StackInput &input, std::size_t p);

/// The stack with the slopes of its bite, where law = "bite"; else as it is.  theory.md (51.5)
/// @param pass  what it gives replaces that of [strip]; without a speed that of the first pass
/// @throws InputError, SolverError  what the slab theory refuses
Stack with_slopes_of_bite(const StackInput &input, const Stack &stack, const Pass &pass = {});
}  // namespace mill
