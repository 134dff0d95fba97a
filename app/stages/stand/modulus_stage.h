#pragma once
#include "app/stages/bearing/bearing_stage.h"
#include "app/stages/bite/bite_results.h"
#include "app/stages/contact/contact_stage.h"
#include "app/stages/stand/model_stage.h"
#include "core/model/four_high.h"

namespace mill {
/// The inputs of the mill modulus of one pass in addition to the results of the run.
struct ModulusParts {
  std::size_t pass           = 0;
  double load                = not_given;                  ///< N, rolling force
  const SolvedContact *upper = nullptr, *lower = nullptr;  ///< K3, K5; null: given
  BiteSpring K4;                                           ///< of the pass; NaN: given
  std::array<Parameter, 2> K_Zy;  ///< N/m, both bearings of the upper and of the lower backup roll
  /// Both bearings of the upper and of the lower backup roll over the rolling force; null: not known for this
  /// pass.
  const std::array<reduce::LoadDeflection, 2> *backup_deflection = nullptr;
  reduce::SolidRolls solid;  ///< for the bending of the work rolls, where the case wants solid rolls
  std::vector<Check> gap;    ///< m/N, opening of the gap per force by other models of the stand, without the bite
};

/// K_ww: both work rolls on each other over the barrel at a rolling force, tangent.  N/m
/// @param K3  the contact computed at the same force, for the error; null: given
Parameter touching_work_rolls(const FourHigh &stand, double load, const Parameter *K3);

/// Opening of the gap per rolling force by beams and finite elements, K4 left out, m/N.  theory.md (30.4)
std::vector<Check> gaps_of(const StandModels &models, MassReference reference);

/// stand.modulus.*, stand.K_ww.*, stand.K_bend, stand.screw_sensitivity, stand.thickness_by.*, stand.force_by.* of
/// the first pass and curves/stand-modulus.csv; of a later pass the same as stand.<pass>.modulus.* and so on,
/// without curve.  Needs K1..K7 and bite.* of the pass; where K4 is given nothing is known of the flattening, and
/// only rolls that kiss have a modulus.
void add_stand_modulus(RunContext &run, const FourHigh &stand, const ModulusParts &parts);
}  // namespace mill
