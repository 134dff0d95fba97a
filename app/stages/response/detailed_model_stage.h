#pragma once
#include "app/run/driven_stand.h"
#include "app/run/run_context.h"
#include "core/model/lumped.h"
#include "reduce/stand/stand_comparison.h"

namespace mill {
/// A model of any number of unknowns from its files, with the modes up to twice its frequency limit.
/// @throws InputError  as detailed_model_of(); matrices whose modes are not those that the case says
reduce::StandWithModes model_from_files(const ModelFiles &files);

/// The stand of files as a pass drives it: its modes, its gap damper, its limit.
void drive_files(DrivenStand &driven, const ModelFiles &files);

/// kind = "lumped" with [model]: its modes f1.. below the limit, and its response to the force of every pass.
void run_detailed_model(RunContext &run, const Lumped &lumped, Goal goal, const std::string &force_file);
}  // namespace mill
