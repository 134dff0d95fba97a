#pragma once
#include "core/base/choice.h"

namespace mill {
/// "status" of results.json of a run that came to its end; of another one it is what ended it.
enum class RunStatus { ok, warnings };
constexpr auto words_of(RunStatus)
{
  return choice_words<RunStatus>("ok", "warnings");
}
}  // namespace mill
