#pragma once
#include "app/command_line.h"
#include "app/pipeline.h"

namespace mill {
struct Case;

/// What a pass of a case drives, by the stages that are needed for it, with progress on the console and no run
/// folder. What the stages warned of is with it.
/// @throws InputError, SolverError as the stages; no pass of that name
DrivenStand driven_case(const CommandLine &command, const Case &the_case);

/// Its warnings on the console.
void say_warnings(const DrivenStand &driven);
}  // namespace mill
