#pragma once
#include "app/review/case_review.h"
#include "core/model/pass.h"
#include "core/records/records.h"
#include <string>

namespace mill {
/// Frequencies between which the modes of the chain are to be expected, by closed forms.
struct ExpectedModes {
  double lowest = 0, highest = 0;  ///< Hz; zero: unknown
  double damping = 0;              ///< -, ratio of critical
};

/// A record is long enough for the level of a mode when its transient has died away: five decay times 1/(2 pi f
/// zeta) of the lowest mode.  s; zero where nothing is known.  theory.md (34.1)
double needed_duration(const ExpectedModes &modes);

/// Force and measured record of one pass.
void review_records(const Pass &pass, const ForceRecord &force, const ExpectedModes &modes, CaseReview &review);
}  // namespace mill
