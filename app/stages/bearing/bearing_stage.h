#pragma once
#include "app/run/run_context.h"
#include "app/stages/bearing/bearing_study.h"
#include "reduce/chain/mill_modulus.h"
#include <array>
#include <vector>

namespace mill {
namespace reduce {
struct ChainInputs;
}
struct BearingCase;
struct FourHigh;
struct LumpedModel;

/// Radial stiffness of the roll-neck bearings at one working load.
struct StandBearings {
  std::array<Parameter, 4>
      Kzc;  ///< N/m, tangent of one bearing: upper backup, upper work, lower work, lower backup
  std::array<Parameter, 4> Kzc_across;  ///< N/m, across the load, the chock on its liners
  std::array<double, 2>
      film_damper{};                 ///< N s/m, oil films of both bearings of the upper, of the lower backup roll
  Parameter K_Zy_upper, K_Zy_lower;  ///< N/m, both bearings of the upper, of the lower backup roll, tangent
  /// Both bearings of the upper and of the lower backup roll over the rolling force, of the first pass; empty
  /// where a bearing is given or its load is not half the rolling force.
  std::array<reduce::LoadDeflection, 2> backup_deflection;
};

/// Solves the bearings of the stand at the loads that each rolling force puts on them; for the first one Kzc1..4.*
/// go into the results and curves/bearing-*.csv are written.  A bearing whose Kzc is given is not solved; across
/// the load nothing is known of it then, and what the chain takes of both bearings of a roll is twice the given
/// one.
/// @param rolling_forces  N, one per pass
std::vector<StandBearings> solve_bearings(RunContext &run, const FourHigh &stand,
                                          const std::vector<double> &rolling_forces);

/// The oil films of the backup rolls into the chain that they are a part of, with the frequency at which it takes
/// them; nothing where the bearing or the spring of the chain is given.
/// @param damper  N s/m, films of both bearings of the upper, of the lower backup roll; 0: none
/// @param inputs  of the chain
void add_films(LumpedModel &chain, const FourHigh &stand, const std::array<double, 2> &damper,
               const reduce::ChainInputs &inputs);

/// Solves the roller bearing of kind = "bearing" and adds its results; no curves, no sentences.
BearingStudy add_bearing_case(RunContext &run, const BearingCase &spec);

/// The same for kind = "bearing": Kzc.*, curves, and the motion of a mass on the bearing when one is given.
void solve_bearing_case(RunContext &run, const BearingCase &spec);
}  // namespace mill
