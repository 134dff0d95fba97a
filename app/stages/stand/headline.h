#pragma once
#include "app/run/run_context.h"
#include "app/stages/stand/model_stage.h"
#include "core/base/warning.h"
#include <optional>

namespace mill {
/// The most detailed model of a stand that has modes: component modes, else beams, else six masses.  Its
/// frequencies and names are those of the run.
const reduce::StandWithModes &best_model(const StandModels &models);

/// For the console: the modes of the best model below the limit (Hz) that the gap or a sensor sees, with the strip
/// between the rolls and without it side by side, compared with the six masses; how many others there are; what
/// the six masses are good for.
std::string headline(const StandStates &states, double limit);

/// Where six masses are used: a sentence if a mode of theirs that moves the gap is off by more than 5 % from that
/// of the best model, with the numbers; else empty.
/// @param limit  Hz, up to which modes are compared
std::optional<Warning> six_mass_gap_error(const StandModels &models, double limit);
/// The same for two models at hand.
std::optional<Warning> six_mass_gap_error(const reduce::StandWithModes &detailed,
                                          const reduce::StandWithModes &chain, double limit);
}  // namespace mill
