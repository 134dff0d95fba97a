#pragma once
#include "core/case/kinds.h"
#include "core/case/stand_reader.h"
#include "core/model/process_advice.h"
#include <vector>

// [advice], [[advice.damper]] and [[advice.tuned_damper]].
namespace mill {
const std::vector<Field<StandAdvice>> &stand_advice_rows();         ///< kind lumped
const std::vector<Field<FourHighAdvice>> &four_high_advice_rows();  ///< the same and those of a pass
const std::vector<Field<DamperProposal>> &damper_proposal_rows();
const std::vector<Field<TunedDamperProposal>> &tuned_proposal_rows();
const std::vector<Field<ChatterAdvice>> &chatter_advice_rows();

std::vector<SectionRows> stand_advice_sections();
std::vector<SectionRows> four_high_advice_sections();
SectionRows chatter_advice_section();
std::vector<TemplateNote> stand_advice_notes();  ///< comments only: without the section sensible actions are tried
TemplateNote chatter_advice_note();

StandAdvice read_stand_advice(const Node &root, Reading &reading);
FourHighAdvice read_four_high_advice(const Node &root, Reading &reading);

/// What belongs to the pass, of a case of kind four-high that read_case() has accepted.
/// @throws InputError as read_case()
RolledAdvice rolled_advice_of(const std::string &path, const std::vector<std::string> &sets = {});

/// @param conditions  that advice.condition may name
ChatterAdvice read_chatter_advice(const Node &root, const std::vector<RollingCondition> &conditions,
                                  Reading &reading);
}  // namespace mill
