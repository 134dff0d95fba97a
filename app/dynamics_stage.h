#pragma once
#include "app/run_context.h"
#include "core/lumped_model.h"
#include "core/records.h"
#include "core/stand.h"

namespace mill {
/// Force record of a pass: its file, or the synthetic noise its keys describe.
ForceRecord force_of(const Pass &pass);

/// Natural frequencies and shapes: f1.., fh1.. and curves/modes*.csv.
void add_modes(RunContext &run, const LumpedModel &model, const DynamicsSettings &settings, double chock_seat,
               std::array<double, 2> chock_mass);

/// Drives the model with the force of a pass: response/<pass>*.csv, peaks and rms beside published and measured
/// ones.
void simulate_pass(RunContext &run, const LumpedModel &model, const DynamicsSettings &settings, const Pass &pass,
                   const ForceRecord &force);
}  // namespace mill
