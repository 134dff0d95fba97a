#pragma once
#include "core/base/choice.h"

namespace mill {
/// The rolls of a stand that turn, each pair at its own speed.
enum class RollKind { work_roll, backup_roll };
constexpr auto words_of(RollKind)
{
  return choice_words<RollKind>("work roll", "backup roll");
}
}  // namespace mill
