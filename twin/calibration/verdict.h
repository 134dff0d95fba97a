#pragma once
#include "twin/calibration/calibration.h"

// Whether a calibration is written, is refused, or changes nothing.  theory.md 45.3, 45.6
namespace mill::twin {
/// Does the case explain the records as well as what was fitted?  (45.8)
/// @param fit_at_case  the fitted and the check records with the case as it is
bool case_agrees(const Calibration &result, const RecordFit &fit_at_case, const RecordFit &check_at_case);

/// Why no case is written with a recorded force; empty: none.
std::vector<std::string> refusals_of(const CalibrationInput &input, const Calibration &result);

/// Refusals that need no spectrum: nothing identified, check no better than before, far from the prior, delay,
/// clipped channels, no convergence.  Where the case agrees, a check that fits no better refuses nothing.
void add_other_refusals(std::vector<std::string> &refusals, const CalibrationInput &input,
                        const Calibration &result);

/// Sentence for the user where the case agrees.
std::string agreement_words(const Calibration &result);
}  // namespace mill::twin
