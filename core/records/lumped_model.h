#pragma once
#include "core/records/parameter.h"
#include <Eigen/Core>
#include <array>
#include <string>

namespace mill {
/// The six-mass chain of a four-high stand at one working load.  theory.md 6
///     ground -K1- M1 -K2- M2 -K3- M3 -(K4 || C)- M4 -K5- M5 -K6- M6 -K7- ground
struct LumpedModel {
  std::array<Parameter, 6> M;  ///< kg, M1..M6
  std::array<Parameter, 7> K;  ///< N/m, K1..K7
  std::array<Parameter, 4>
      Kzc;  ///< N/m, one bearing along its load: upper backup, upper work, lower work, lower backup; NaN: unknown
  std::array<Parameter, 4> Kzc_across;  ///< N/m, the same across the load, chock on its liners; NaN: unknown
  Parameter C;                          ///< N s/m, damper beside K4
  OperatingPoint at;                    ///< working load, "976.2 kN"; empty for a given model
};

/// A given model of kind = "lumped": every missing M1..M6, K1..K7 has been reported by the reader.
struct Case;
LumpedModel lumped_model_of(const Case &lumped_case);

/// lumped_model.toml: a valid kind = "lumped" case with value, unit, source, at, inputs of every entry and the
/// passes, dynamics and Campbell diagram of the case it came from.  Returns the text; passes' paths are made
/// relative to `directory`.
std::string lumped_model_toml(const LumpedModel &model, const Case &origin, const std::string &directory);
}  // namespace mill
