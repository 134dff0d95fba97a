#pragma once
#include "app/kinds/pipeline.h"
#include "dynamics/fmu/exported_model.h"
#include "dynamics/nonlinear/curve_stand.h"

namespace mill {
struct Case;

/// The members of a unit's model from our own structures.
/// @param longest_step  s
fmu::CurveData curve_data(const dynamics::CurveStand &stand, double longest_step);

/// Number of steps of a unit in one step of the output rate (1/s): none is longer than a fortieth of the shortest
/// period.
int steps_between_outputs(const dynamics::CurveStand &stand, double output_rate);

/// As exported_model(), of a stand whose contacts and bearings follow their curves: in its modes, checked against
/// the fixed-step run of the program.  theory.md 36.8
fmu::ExportedModel exported_curves(const DrivenStand &stand, const Case &of);
}  // namespace mill
