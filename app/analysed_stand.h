#pragma once
#include "core/records/lumped_model.h"
#include "twin/analysis/analysis.h"
#include <string>

namespace mill {
struct Case;

/// What the case of a record says of its stand: modes with shares, rolls, bearings.  Kind lumped as given; kind
/// four-high by closed forms at the load of its first pass (theory.md 24), since a record is analysed in seconds.
/// @throws InputError  a kind without a stand that vibrates, a stand in files
twin::CaseModel analysed_stand(const Case &the_case);

/// The six masses behind it.
struct AnalysedChain {
  LumpedModel model;
  std::string source;  ///< "six masses as given", "six masses by closed forms at 976.2 kN"
};

/// @param load  N, that a four-high stand is computed for; NaN: that of its first pass
/// @param verb  of the message
/// @throws InputError  as analysed_stand
AnalysedChain analysed_chain(const Case &the_case, double load, const std::string &verb);
}  // namespace mill
