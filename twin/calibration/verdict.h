#pragma once
#include "twin/calibration/calibration.h"

// Whether a calibration is written, refused, or has nothing to change.  theory.md 45.3, 45.5
namespace mill::twin {
/// Does the case explain the records as well as what was fitted?  (45.7)
/// @param fit_at_case  the fitted and the check records with the case as it is
bool case_agrees(const Calibration &result, const Held &fit_at_case, const Held &check_at_case);

/// Why no case is written; empty: none.  Where the case agrees, a check that fits no better is no reason.
std::vector<std::string> refusals_of(const CalibrationInput &input, const Calibration &result);

/// What a user is told where the case agrees.
std::string agreement_words(const Calibration &result);
}  // namespace mill::twin
