#pragma once
#include "core/base/choice.h"

namespace mill {
/// "kind" of a case file and of run.json, in the order of Case::spec.
enum class KindOfCase { four_high, lumped, two_cylinders, bearing, bite, chatter, cluster, stack };
constexpr auto words_of(KindOfCase)
{
  return choice_words<KindOfCase>("four-high", "lumped", "two-cylinders", "bearing", "bite", "chatter", "cluster",
                                  "stack");
}
}  // namespace mill
