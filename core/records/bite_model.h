#pragma once
#include "core/base/choice.h"

namespace mill {
/// What computed a bite, as results and files name it, "bite.PASS.karman.force".
enum class BiteModel { fe, karman, karman_rigid, karman_elastic_arc, orowan, bland_ford, hu_ehmann, sims };
constexpr auto words_of(BiteModel)
{
  return choice_words<BiteModel>("fe", "karman", "karman-rigid", "karman-elastic-arc", "orowan", "bland-ford",
                                 "hu-ehmann", "sims");
}
}  // namespace mill
