#pragma once
#include "app/trace/closed_form_parts.h"
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include <string>
#include <vector>

namespace mill {
struct Case;

/// The six masses that a case says or implies, within milliseconds.
struct CaseChain {
  LumpedModel model;
  DynamicsSettings dynamics;
  std::string source;                     ///< "six masses by closed forms at 976.2 kN"
  double load = not_given;                ///< N, of a four-high
  std::vector<ClosedFormResult> results;  ///< behind those of a four-high
};

/// Kind lumped as given; kind four-high by closed forms at the load of its first pass (theory.md 24); kind chatter
/// as its stand is given, without the bite.
/// @param verb  that asks, for the refusal
/// @param load  N, that a four-high is computed for; NaN: that of its first pass
/// @throws InputError  a kind without a chain, a stand in files
CaseChain case_chain(const Case &the_case, const std::string &verb, double load = not_given);
}  // namespace mill
