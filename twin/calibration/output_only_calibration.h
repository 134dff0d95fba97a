#pragma once
#include "twin/calibration/calibration.h"

namespace mill::twin {
/// A calibration by accelerations alone, one force of unknown course eliminated.  theory.md 44.5, 45.5
/// Cost: 12 s for 20 s of two sensors and seven unknowns on two threads.
Calibration calibrate_output_only(const CalibrationInput &input, const Progress &progress);
}  // namespace mill::twin
