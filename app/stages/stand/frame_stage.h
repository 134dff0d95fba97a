#pragma once
#include "app/run/run_context.h"
#include "core/model/four_high.h"
#include "reduce/stand/lumped_stand.h"

namespace mill {
/// Puts what [housing] and [screwdown] give into stand.frame: frame.* results with closed forms and the given
/// values that they are compared with, fields/housing.vtu; the errors of its meshes become tolerances of the
/// frame.
void resolve_frame(RunContext &run, FourHigh &stand);

/// Puts a frame on its measured mill modulus, at the load of the first pass, and adds what each stiffness becomes.
/// theory.md (30.11)
/// @throws InputError  rolls, contacts and bearings are softer than the modulus
void close_frame(RunContext &run, FourHigh &stand, const reduce::ChainInputs &inputs);
}  // namespace mill
