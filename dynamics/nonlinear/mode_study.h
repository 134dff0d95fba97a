#pragma once
#include "core/records/nonlinear_record.h"
#include "dynamics/nonlinear/curve_response.h"
#include <vector>

// What amplitude does to the modes of a stand on curves.  theory.md 36.5
namespace mill::dynamics {
/// Backbone curves, parting forces and harmonics of every mode up to `highest` (Hz) that strains a spring with a
/// curve.
/// @param model       made from the same modes as `stand`; its first six points are M1..M6
/// @param run         the run whose largest modal displacements are looked up on the backbone curves
/// @param force       N, amplitude of the harmonic force behind the harmonics
/// Cost: per mode some forty solutions of s (2 h + 1) equations.
std::vector<NonlinearMode> mode_study(const CurveStand &stand, const ModalModel &model, const CurveRun &run,
                                      double force, double highest);

/// How many times the fluctuation of a record until a spring parts, by fixed steps and the secant method; NaN
/// where a thousand times is not enough or nothing holds the stand then.
/// @param least  smallest force over that at rest with the record as it is
/// Cost: some five runs of fixed_step_response.
double scale_to_part(const CurveStand &stand, const ModalModel &model, const ForceRecord &force,
                     double output_rate, double least);
}  // namespace mill::dynamics
