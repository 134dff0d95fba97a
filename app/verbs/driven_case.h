#pragma once
#include "app/command/command_line.h"
#include "app/kinds/pipeline.h"
#include "app/run/run_context.h"
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace mill {
struct Case;

/// What a pass of a case drives, by the stages that are needed for it, with progress on the console and no run
/// folder. What the stages warned of is with it.
/// @throws InputError, SolverError as the stages; no pass of that name
DrivenStand driven_case(const CommandLine &command, const Case &the_case);

/// Stages for a verb that keeps no run folder: with cache, threads and progress on the console.
/// @param stages  with their weights, as RunKind::stages
/// @throws what `work` throws
void run_in_scratch(const CommandLine &command, const Case &the_case,
                    const std::vector<std::pair<std::string, double>> &stages,
                    const std::function<void(RunContext &run)> &work);

/// What stages warned of, on the console.
void say_warnings(const std::vector<Warning> &warnings);
}  // namespace mill
