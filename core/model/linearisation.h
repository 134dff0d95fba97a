#pragma once
#include "core/base/choice.h"

namespace mill {
/// How much of the bite follows a disturbance.  The flattened radius never does.
enum class Linearisation {
  sequential,      ///< film and exit point keep the strip speeds of the steady state
  implicit,        ///< everything follows
  frozen_friction  ///< friction and exit point keep their steady values
};
constexpr auto words_of(Linearisation)
{
  return choice_words<Linearisation>("sequential", "consistent", "frozen-friction");
}
}  // namespace mill
