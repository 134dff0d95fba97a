#pragma once
#include "app/command/command_line.h"

namespace mill {
struct Case;

/// millstand export fmu: the model that a pass drives, as a functional mock-up unit that has reproduced our own
/// integrator.  Returns the exit code.
/// @throws InputError  a kind without such a model, no pass of that name, an output that is not an
///         archive of this program
int export_command(const CommandLine &command, const Case &the_case);
}  // namespace mill
