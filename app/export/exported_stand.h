#pragma once
#include "app/kinds/pipeline.h"
#include "dynamics/fmu/exported_model.h"
#include "dynamics/response/response.h"

namespace mill {
struct Case;

/// A stand in its modes.
fmu::ModelData modal_data(const dynamics::ModalModel &modes);

/// The stand in its modes, or its chain.
dynamics::DrivenModel driven_of(const DrivenStand &stand);

/// -, of critical: what the dampers of the oil films add to the damping of the mode that they damp most, for small
/// damping phi^T C phi/(2 w), with a locked film at the frequency of each mode (29.19); 0: no films.
double film_damping(const DrivenStand &stand);

/// s, the longest communication step that a client should take which holds the force over it: an equal part of the
/// output step and at most 1/(20 f).
/// @param highest  Hz, frequency of the fastest mode
double held_step(double output_rate, double highest);

/// The stand as a unit needs it: model data, source of each start value, the recorded force, and
/// the run that the unit must reproduce.  theory.md 35
fmu::ExportedModel exported_model(const DrivenStand &stand, const Case &of);
}  // namespace mill
