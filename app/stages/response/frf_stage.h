#pragma once
#include "app/run/run_context.h"
#include "core/case/provenance.h"
#include "core/model/dynamics_settings.h"
#include "core/model/frequency_response.h"
#include "reduce/stand/stand_comparison.h"
#include "reduce/stand/stand_errors.h"
#include <string>
#include <vector>

namespace mill {
/// Whose frequency response is wanted.
struct RespondingStand {
  /// Models of one stand, the best one first: its responses are the results, with a band.
  std::vector<const reduce::StandWithModes *> models;
  GapState named = GapState::rolling;               ///< state whose names their frequencies have in the results
  std::vector<reduce::ModalSensitivity> uncertain;  ///< inputs of the first one
  double gap_damper = 0;                            ///< N s/m
  double limit      = not_given;                    ///< Hz, up to which its modes are right; NaN: all are
  OperatingPoint at;                                ///< load of the tangents, "976.2 kN"
  KeyList inputs;                                   ///< keys behind the first model
};

/// Accelerance of rolls and chocks for a force in the bite, at every roll and every chock: curves/frf-*.csv,
/// frf.<force>.<place>.peak and .frequency.  theory.md 32
/// @throws InputError  a resolution that asks for too many frequencies
void add_frequency_responses(RunContext &run, const FrequencyResponseSettings &settings,
                             const DynamicsSettings &dynamics, const RespondingStand &stand);
}  // namespace mill
