#pragma once
#include "core/base/choice.h"

namespace mill::live {
/// Members of a line that are not channels: number of its first sample; those of the head.
enum class LineWord { first_sample, units, head };
constexpr auto words_of(LineWord)
{
  return choice_words<LineWord>("s", "units", "millstand");
}
}  // namespace mill::live
