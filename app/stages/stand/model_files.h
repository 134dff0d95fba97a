#pragma once
#include "app/run/run_context.h"
#include "app/stages/stand/model_stage.h"
#include "core/model/lumped.h"

namespace mill {
struct FourHigh;

/// Files of one model of the stand for other programs:
///   models/<name>-mass.mtx, -stiffness.mtx, -force.mtx, -readings.mtx, -names.csv, -connections.csv, -strains.mtx
///   models/<name>-damping.mtx, models/<name>.mat   up to 100 unknowns, or with dynamics.model_files =
///   ModelFileSet::all fields/modes-<name>.vtu                        mode shapes along the rolls, where the model
///   has lines lumped_model-<name>.toml                       the case that reads it back; not of the six masses
void write_model_files(RunContext &run, const FourHigh &stand, const reduce::StandWithModes &model,
                       const LumpedModel &chain);

/// The same without fields/, of any kind of case with passes and dynamics.
/// @param gap_damper  N s/m
void write_model_matrices(RunContext &run, const DynamicsSettings &dynamics, const reduce::StandWithModes &model,
                          double gap_damper);

/// What names the files of a model in models/, with its modes up to the limit (Hz) to know the matrices by.
/// @param gap_damper  N s/m; NaN or 0: none
ModelFiles model_case_files(const reduce::StandWithModes &model, double frequency_limit, double gap_damper);

/// fields/modes-<name>-rolls.vtu: displacement vector and stress tensor of each mode below the limit on the
/// outside of the rolls by finite elements, both halves about y = 0 of the quarter x, z >= 0, about 1 MB a mode at
/// most.
void write_roll_shapes(RunContext &run, const FourHigh &stand, const reduce::StandWithModes &model,
                       const Component &work_roll, const Component &backup_roll);
}  // namespace mill
