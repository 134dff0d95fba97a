#pragma once
#include "core/base/parameter.h"
#include "core/model/material.h"
#include <Eigen/Core>
#include <array>
#include <string>

namespace mill {
/// The oil films of both bearings of a backup roll, a part of K2 or of K6: k + i w b.  theory.md 29.6
struct ChainFilm {
  double stiffness = 0;  ///< N/m, as it is in the spring of the chain
  double damper    = 0;  ///< N s/m; 0: no oil film
};

/// The six-mass chain of a four-high stand at one working load.  theory.md 6
///     ground -K1- M1 -K2- M2 -K3- M3 -(K4 || C)- M4 -K5- M5 -K6- M6 -K7- ground
struct LumpedModel {
  std::array<Parameter, 6> M;  ///< kg, M1..M6
  std::array<Parameter, 7> K;  ///< N/m, K1..K7
  std::array<Parameter, 4>
      Kzc;  ///< N/m, one bearing along its load: upper backup, upper work, lower work, lower backup; NaN: unknown
  std::array<Parameter, 4> Kzc_across;  ///< N/m, the same across the load, chock on its liners; NaN: unknown
  Parameter C;                          ///< N s/m, damper in parallel with K4
  OperatingPoint at;                    ///< working load, "976.2 kN"; empty for a given model
  std::array<ChainFilm, 2> film;        ///< upper, lower backup roll
  double film_frequency = not_given;    ///< Hz, at which the chain in motion takes them; NaN: at rest
  /// kg, M1..M6 in motion, of shapes in which the films are as stiff as at that frequency; NaN: those at rest
  std::array<double, 6> moving_mass{not_given, not_given, not_given, not_given, not_given, not_given};
};
}  // namespace mill
