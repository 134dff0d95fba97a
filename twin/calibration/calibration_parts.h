#pragma once
#include "twin/calibration/calibration.h"
#include <functional>

// What calibrations with and without a recorded force have in common.
namespace mill::twin {
constexpr double other_basin    = 9;  ///< deviance below which a second minimum may be the right one
constexpr double far_from_prior = 3;  ///< prior sd beyond which a change contradicts the case
/// Pieces of records as transforms in the band that is fitted.
MeasuredResponse measured_response(const CalibrationInput &input, const std::vector<ForcedSamples> &pieces);
double seconds_of(const MeasuredResponse &data);  ///< s

/// What is identified, what is not, and why.
/// @param sd  (p) after the records
std::vector<Calibrated> judged(const ScannedFit &scan, const Eigen::VectorXd &sd);

/// The fit of some records by unknowns whose priors are others.
using ProblemOf = std::function<FitProblem(const std::vector<Unknown> &)>;

constexpr double most_kept_deviance = 3.84;  ///< chi-square of one, 95 %

/// What is identified, fitted again with the rest at its prior; fills kept, taken and kept_deviance.  Where that
/// raises the deviance by more than 3.84, the records contradict a prior: then the unknown of the rest of which
/// they say most is fitted too, and so on.  (45.9)
/// @param joint  its unknowns begin with those of the result; more may follow, which stay free
/// @return of all unknowns of the joint fit
Eigen::VectorXd keep_priors(const ProblemOf &problem_of, const Fit &joint, int threads, Calibration &result);
}  // namespace mill::twin
