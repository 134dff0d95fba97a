#pragma once
#include "app/run/run_context.h"
#include "core/case/provenance.h"
#include "core/model/dynamics_settings.h"
#include "dynamics/response/response_study.h"

namespace mill {
/// Whose frequency response is wanted; the first of its models gives the results.
struct RespondingStand : dynamics::StandInModels {
  GapState named = GapState::rolling;  ///< state whose names their frequencies have in the results
  OperatingPoint at;                   ///< load of the tangents, "976.2 kN"
  KeyList inputs;                      ///< keys behind the first model
};

/// Accelerance of rolls and chocks for a force in the bite, at every roll and every chock: curves/frf-*.csv,
/// frf.<force>.<place>.peak and .frequency.  theory.md 32
/// @throws InputError  a resolution that asks for too many frequencies
void add_frequency_responses(RunContext &run, const FrequencyResponseSettings &settings,
                             const DynamicsSettings &dynamics, const RespondingStand &stand);
}  // namespace mill
