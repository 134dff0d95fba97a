#pragma once
#include "core/base/choice.h"

namespace mill {
/// The rolls of a stand that turn, each pair at its own speed.
enum class RollKind { work_roll, backup_roll };
constexpr auto words_of(RollKind)
{
  return choice_words<RollKind>("work roll", "backup roll");
}

/// The rolls of a four-high from above; also the places of its bearings, Kzc1 to Kzc4.
enum class RollPlace { upper_backup, upper_work, lower_work, lower_backup };
constexpr auto words_of(RollPlace)
{
  return choice_words<RollPlace>("upper backup roll", "upper work roll", "lower work roll", "lower backup roll");
}
inline bool is_work_roll(const RollPlace place)
{
  return place == RollPlace::upper_work || place == RollPlace::lower_work;
}
}  // namespace mill
