#pragma once
#include "app/twin/stand/case_chain.h"
#include "core/base/warning.h"
#include "core/model/four_high.h"
#include "reduce/stand/beam_stand.h"
#include "reduce/stand/stand_comparison.h"
#include <optional>

namespace mill {
/// N s/m between the work rolls, as the case means its force.
double gap_damper_of(const LumpedModel &chain, const DynamicsSettings &settings);

/// What a detailed stand is made of, by the same closed forms as the chain.
struct DetailParts {
  FourHigh stand;
  reduce::StandSprings springs;
  double gap_damper = 0;
};

/// @param chain  case_chain() of the drawn stand
DetailParts detail_parts(const FourHigh &drawn, const CaseChain &chain);

/// The drawn stand with rolls as beams and all else by closed forms, its modes up to twice the frequency limit.
/// Cost: 0.1 s.
reduce::StandWithModes closed_form_beams(const FourHigh &drawn, const CaseChain &chain);

/// Where six masses are used for a drawing: a sentence if they put a mode of the gap more than 5 % from that of
/// the beams; else empty, also for a case without a drawing.
/// @param verb  as case_chain()
std::optional<Warning> warning_of_six_masses(const Case &the_case, const std::string &verb);
}  // namespace mill
