#pragma once
#include "app/run/run_context.h"
#include "app/stack/stack_stage.h"
#include "app/stages/bearing/bearing_study.h"
#include "core/model/stack_input.h"
#include <map>
#include <string>

// Roller bearings of the case that hold rolls of a stack.
namespace mill {
/// By their names, each over the loads that the settings of the stack may put on it.
using StackBearings = std::map<std::string, BearingStudy>;

/// Those that a roll names; nothing is computed where no roll does.
/// @throws InputError, SolverError  what the study of a bearing refuses
StackBearings solve_stack_bearings(RunContext &run, const StackInput &input, const Stack &stack);

/// The stack with the curves of its bearings, which an engine takes at the load on each.  theory.md (51.25)
Stack with_bearing_curves(Stack stack, const StackBearings &bearings);
/// The same with one bearing softer by a share of its deflection at every load.
Stack with_softer_bearing(Stack stack, const std::string &bearing, double share);
/// The same between rigid rings, without finite elements: what a trace follows.
Stack with_rigid_bearings(const StackInput &input, Stack stack);

/// roll.NAME.bearing_stiffness of the heavier bearing of each roll, under its load.
/// @param stack  with its curves and a rolling force; without a force the list is empty
StackNumbers bearing_numbers(const Stack &stack);

/// roll.NAME.bearing_stiffness, curves/bearing-NAME.csv, and what the reader of the report has to know.
/// @param solved  with its rolling force
void add_stack_bearings(RunContext &run, const StackInput &input, const Stack &solved,
                        const StackBearings &bearings);
}  // namespace mill
