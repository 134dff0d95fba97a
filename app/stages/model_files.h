#pragma once
#include "app/run_context.h"
#include "app/stages/model_stage.h"

namespace mill {
struct FourHigh;

/// Files of one model of the stand for other programs:
///   models/<name>-mass.mtx, -stiffness.mtx, -force.mtx, -readings.mtx, -names.csv   always
///   models/<name>-damping.mtx, models/<name>.mat   up to 100 unknowns, or with dynamics.model_files = "all"
///   fields/modes-<name>.vtu                        mode shapes along the rolls, where the model has lines
///   lumped_model-<name>.toml                       the case that reads it back; not of the six masses
void write_model_files(RunContext &run, const FourHigh &stand, const reduce::StandWithModes &model,
                       const LumpedModel &chain);
}  // namespace mill
