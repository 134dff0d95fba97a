#pragma once
#include "core/base/choice.h"

namespace mill {
/// What an advice is about, by the words of advice.json.
enum class RatedGoal { level, critical_speed };
constexpr auto words_of(RatedGoal)
{
  return choice_words<RatedGoal>("level", "critical speed");
}
}  // namespace mill
