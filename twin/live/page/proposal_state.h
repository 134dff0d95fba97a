#pragma once
#include "core/base/choice.h"

namespace mill::live {
enum class ProposalState { open, adopted, out_of_date };
constexpr auto words_of(ProposalState)
{
  return choice_words<ProposalState>("open", "adopted", "out of date");
}
}  // namespace mill::live
