#pragma once
#include "app/stages/bearing_stage.h"
#include "app/stages/contact_stage.h"
#include "app/stages/model_stage.h"
#include "core/model/four_high.h"
#include "reduce/chain/roll_shapes.h"

namespace mill {
/// What the mill modulus is made of beside the results of the run; of the first pass.
struct ModulusParts {
  double load               = not_given;                  ///< N, rolling force
  const ContactCurve *upper = nullptr, *lower = nullptr;  ///< roll contacts; null: given
  const StandBearings *seats = nullptr;
  reduce::SolidRolls solid;  ///< for the bending of the work rolls, where the case wants solid rolls
  std::vector<Check> gap;    ///< m/N, opening of the gap per force by other models of the stand, without the bite
};

/// Opening of the gap per rolling force by beams and finite elements, K4 left out, m/N.  theory.md (30.4)
std::vector<Check> gaps_of(const StandModels &models, const std::string &reference);

/// stand.modulus.*, stand.K_ww.*, stand.K_bend, stand.screw_sensitivity, stand.thickness_by.*, stand.force_by.* of
/// the first pass and curves/stand-modulus.csv.  Needs K1..K7, K4.flattening and bite.* of the run; where K4 is
/// given nothing is known of the flattening, and only rolls that kiss have a modulus.
void add_stand_modulus(RunContext &run, const FourHigh &stand, const ModulusParts &parts);
}  // namespace mill
