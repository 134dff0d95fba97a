#pragma once
#include "app/stack/stack_stage.h"

// What a reader of the results of a stack has to know in addition to the numbers.
namespace mill {
/// Contacts that are open or beyond yield, a strip at the end of a barrel, a gap that closes.
void warn_of_state(RunContext &run, const SolvedStack &solved);

/// Contacts whose change of the approach has no sign along their length, (51.21).
void note_missing_tangents(RunContext &run, const StackNumbers &numbers);

/// What the results take for granted: rigid bearings, no flow across the width.
void say_what_is_assumed_of(RunContext &run, const StackInput &input);
}  // namespace mill
