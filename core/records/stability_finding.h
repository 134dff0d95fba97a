#pragma once
#include "core/base/choice.h"

namespace mill {
/// What a search for the critical speed finds.
enum class StabilityFinding {
  crossing,             ///< stable below the critical speed, unstable above it
  stable,               ///< nothing grows at any speed of the range that has a bite
  unstable,             ///< something grows at every such speed
  unstable_below,       ///< unstable at the low end, stable above, without a crossing upward: no critical speed
  unstable_beyond_gap,  ///< stable below a gap of speeds without an answer, unstable above it: the critical speed
                        ///< lies in the gap
  no_bite               ///< no steady bite in the range
};
constexpr auto words_of(StabilityFinding)
{
  return choice_words<StabilityFinding>("crossing", "stable", "unstable", "unstable below",
                                        "unstable beyond a gap", "no bite");
}
}  // namespace mill
