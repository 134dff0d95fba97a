#pragma once
#include "app/run/run_context.h"
#include "app/stages/response/contact_curves.h"
#include "core/base/parameter.h"
#include "core/records/key_list.h"
#include "dynamics/nonlinear/curve_study.h"

namespace mill {
struct Pass;

/// Checks of a level on the curves: the linear run and the fixed steps.
/// @param column  of the accelerations
/// @param peak    the largest value, else the rms; g
std::vector<Check> checks_of_level(const dynamics::CurveRuns &runs, int column, bool peak);

/// What drives a stand on curves.
struct DrivenPass {
  const DynamicsSettings &settings;
  const Pass &pass;
  const ForceRecord &force;
  std::string method;  ///< of the linear model
  KeyList inputs;      ///< keys behind model and force
};

/// nonlinear.<pass>.*, curves/nonlinear-<pass>.json, curves/nonlinear-<pass>-spectrum.csv,
/// curves/backbone-<pass>.csv, response/<pass>-parted.csv, and a warning where linear springs were not enough.
void add_nonlinear(RunContext &run, const CurveDrive &drive, const dynamics::CurveRuns &runs,
                   const DrivenPass &driven);
}  // namespace mill
