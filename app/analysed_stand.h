#pragma once
#include "core/model/dynamics_settings.h"
#include "core/model/material.h"
#include "core/records/lumped_model.h"
#include "twin/analysis/analysis.h"

namespace mill {
struct Case;

/// What the case of a record says of its stand: modes with shares, rolls, bearings.  Kind lumped as given; kind
/// four-high by closed forms at the load of its first pass (theory.md 24), since a record is analysed in seconds.
/// @throws InputError  a kind without a stand that vibrates, a stand in files
twin::CaseModel analysed_stand(const Case &the_case);

/// The same stand as a chain that can be driven.
struct AnalysedChain {
  LumpedModel model;
  DynamicsSettings dynamics;
  std::string source;       ///< "six masses by closed forms at 976.2 kN", "six masses as given"
  double load = not_given;  ///< N, of the closed forms; NaN: as given
};
/// @param verb  named where the case does not fit
/// @param load  N, of the closed forms; 0: that of the first pass
/// @throws InputError as analysed_stand()
AnalysedChain analysed_chain(const Case &the_case, const std::string &verb, double load = 0);
}  // namespace mill
