#pragma once
#include "twin/calibration/calibration.h"

// What other minima mean for what is identified where records leave more than one.  theory.md 45.5
namespace mill::twin {
/// Where the lowest minimum contradicts the case (beyond 3 prior sd) and another one, deviance below 9,
/// is, the records do not tell them apart: the latter becomes the fit and the former another minimum.
/// @param p  unknowns of the stand, the first of the problem's
void prefer_a_correction(const FitProblem &problem, Eigen::Index p, const FitSettings &settings, ScannedFit &scan);

/// What is identified, with intervals that also cover the ends of the scanned springs' intervals and other minima
/// below deviance 9, and deviations of at least 1/3.92 of them and 1/6 of the part of a profile below 9.  A
/// minimum inside the interval of its own spring is part of what that says; one outside is a second value, and the
/// spring is not identified.
std::vector<Calibrated> judged_with_minima(const ScannedFit &scan);
}  // namespace mill::twin
