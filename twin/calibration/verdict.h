#pragma once
#include "twin/calibration/calibration.h"

// Whether a calibration is written, refused, or has nothing to change.  theory.md 45.3, 45.6
namespace mill::twin {
/// Does the case explain the records as well as what was fitted?  (45.8)
/// @param fit_at_case  the fitted and the check records with the case as it is
bool case_agrees(const Calibration &result, const Held &fit_at_case, const Held &check_at_case);

/// Why no case is written with a recorded force; empty: none.
std::vector<std::string> refusals_of(const CalibrationInput &input, const Calibration &result);

/// Refusals that no spectrum is needed for: nothing told, check no better than before, far from the prior, delay,
/// clipped channels, no convergence.  Where the case agrees, a check that fits no better is no reason.
void add_other_refusals(std::vector<std::string> &refusals, const CalibrationInput &input,
                        const Calibration &result);

/// What a user is told where the case agrees.
std::string agreement_words(const Calibration &result);
}  // namespace mill::twin
