#pragma once
#include "core/base/errors.h"
#include <string>

namespace mill {
/// Settings of the lumped model's runs.
struct DynamicsSettings {
  double modal_damping       = 0.01;           ///< -, ratio of critical, every mode
  std::string force_meaning  = "measured";     ///< measured | disturbance | published
  double output_rate         = 20e3;           ///< Hz
  std::string frame          = "open";         ///< open | closed
  std::string contact        = "linear";       ///< linear | curve: springs of roll contacts and bearings
  std::string mass_reference = "mid";          ///< mid | mean: reference displacement of M2..M5
  std::string mass_source    = "closed-form";  ///< closed-form | fe: shapes behind M2..M5
  std::string model          = "six-mass";     ///< six-mass | beam | craig-bampton: what is driven
  double frequency_limit     = 1000;           ///< Hz, up to which the modes are to be right
  int elements_per_radius    = 3;              ///< of the rolls' meshes behind their modes
  std::string model_files    = "small";        ///< small | all: files of models with many unknowns
  Place force_meaning_place;
};

/// The strip between the work rolls as a spring, or nothing.  theory.md 22.9
enum class GapState {
  rolling,  ///< K4 between the work rolls
  open      ///< K4 = 0: what a measured force drives, since it holds the answer of the strip
};

/// The state that the force of the settings drives.
inline GapState driven_state(const DynamicsSettings &settings)
{
  return settings.force_meaning == "measured" ? GapState::open : GapState::rolling;
}

/// The same settings for the modes of a state, whatever the force means.
inline DynamicsSettings in_state(DynamicsSettings settings, const GapState state)
{
  settings.force_meaning = state == GapState::open ? "measured" : "disturbance";
  return settings;
}
}  // namespace mill
