#pragma once
#include "core/base/choice.h"

namespace mill {
/// What millstand asks of millstand-study, the program that is linked with OpenTURNS.
enum class StudyTask { draw, indices, chaos };
constexpr auto words_of(StudyTask)
{
  return choice_words<StudyTask>("draw", "indices", "chaos");
}
}  // namespace mill
