#pragma once
#include "core/base/choice.h"

namespace mill {
/// "status" of calibration.json.
enum class CalibrationStatus {
  ok,
  agrees,  ///< the case already agrees with the records
  refused,
  accepted  ///< refused, and written all the same
};
constexpr auto words_of(CalibrationStatus)
{
  return choice_words<CalibrationStatus>("ok", "agrees", "refused", "accepted");
}
}  // namespace mill
