#pragma once
#include "app/run/run_context.h"
#include "core/model/chain_curves.h"
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "core/records/records.h"
#include "dynamics/nonlinear/curve_model.h"
#include "dynamics/nonlinear/curve_study.h"
#include "reduce/chain/mill_modulus.h"
#include "reduce/stand/lumped_stand.h"
#include "reduce/stand/stand_comparison.h"
#include <array>
#include <string>
#include <vector>

namespace mill {
struct Pass;

/// The driven pass on curves, and the linear model of the same stand at the same load.
struct CurveDrive : dynamics::DrivenCurves {
  std::vector<std::string> mode_names;  ///< empty: not named
  double load = 0;                      ///< N, at rest
};

/// Curves of a four-high at one working load; null or empty: not computed.
struct StandCurves {
  const ContactCurve *upper = nullptr, *lower = nullptr;            ///< K3, K5
  const std::array<reduce::LoadDeflection, 2> *bearings = nullptr;  ///< both bearings of upper, lower backup roll
};

/// The curves of roll contacts and backup-roll bearings in place of their slopes.  Each keeps its shape; a
/// compliance in series makes its slope at the load that of the linear model, and is recorded.
/// @param detailed  the model that is driven; null: the six masses
/// @throws InputError  a load that is not positive; a curve that does not rise
CurveDrive curve_drive(RunContext &run, const StandCurves &curves, const reduce::LumpedStand &chain,
                       const reduce::StandWithModes *detailed, const DynamicsSettings &settings, const Pass &pass,
                       double load);

/// A chain whose springs have the slopes of their curves at a load (N); the others stay.
/// @throws InputError  a load that is not positive
LumpedModel at_load(RunContext &run, LumpedModel model, const ChainCurves &curves,
                    const DynamicsSettings &settings, const Pass &pass, double load);
/// @param model  at_load()
CurveDrive curve_drive(const ChainCurves &curves, const DynamicsSettings &settings, const LumpedModel &given,
                       const LumpedModel &model, double load);

/// The curves of a four-high for its lumped_model.toml.
ChainCurves chain_curves_of(const StandCurves &curves, const reduce::LumpedStand &chain, double load);
}  // namespace mill
