#pragma once
#include "app/command/command_line.h"

namespace mill {
/// Carries out one verb; returns the exit code.
/// @throws InputError, SolverError
int carry_out(const CommandLine &command);

/// Path of run.json of the run that was under way, for the message about our own bug; empty when none.
std::string current_manifest();
}  // namespace mill
