#pragma once
#include "dynamics/chatter/run.h"
#include "dynamics/fmu/exported_model.h"
#include <string>

namespace mill {
struct Case;
struct ChatterCase;

/// The members of a unit's model from our own structures.
/// @param start  m, displacement of both work rolls at the start
fmu::ChatterData chatter_data(const dynamics::ChatterStandModel &stand, const dynamics::WorkingPoint &point,
                              Linearisation scheme, const dynamics::ChatterRunOptions &options, double start);

/// A condition of a chatter case as a unit needs it: stand, bite and strip, and the nonlinear run that the unit
/// must reproduce.  theory.md 37
/// @param condition  its name; empty: the first
/// @throws InputError, SolverError  no condition of this name; no steady bite
fmu::ExportedModel exported_chatter(const ChatterCase &spec, const std::string &condition, const Case &of);
}  // namespace mill
