#pragma once
#include "core/base/choice.h"

namespace mill {
/// Which value of its objective a study searches.
enum class SearchGoal { least, greatest };
constexpr auto words_of(SearchGoal)
{
  return choice_words<SearchGoal>("least", "greatest");
}
}  // namespace mill
