#pragma once
#include "core/base/choice.h"

namespace mill {
/// What of a condition is compared with published and measured values.
enum class PublishedQuantity { critical_speed, rolling_force, friction };
constexpr auto words_of(PublishedQuantity)
{
  return choice_words<PublishedQuantity>("critical speed", "rolling force", "friction");
}
}  // namespace mill
