#pragma once
#include "app/command/command_line.h"

namespace mill {
struct Case;

/// millstand stack optimise: settings of the actuators of a case of kind "stack" for a wanted profile.  Returns
/// the exit code.
/// @throws InputError  another kind, targets or bounds that cannot be read; SolverError  no equilibrium
int stack_command(const CommandLine &command, const Case &the_case);
}  // namespace mill
