#pragma once
#include "twin/calibration/basins.h"
#include <string>
#include <vector>

// Frequencies of the calibrated stand, with what the records leave open of them.  theory.md 45.7
namespace mill::twin {
/// A mode of the calibrated stand.
struct PredictedMode {
  double before;                      ///< Hz, of the case
  double frequency;                   ///< Hz, of the calibrated case
  double low, high;                   ///< Hz, 95 %
  std::vector<std::string> rests_on;  ///< unknowns that leave it open, most first; empty where it is determined
  bool determined() const
  {
    return rests_on.empty();
  }
};

/// Modes up to `highest`.  The interval is that of the joint fit by its covariance, and covers the calibrated
/// stand, the ends of the intervals of the scanned springs, other minima below deviance 9, and other places that
/// the records allow for the resonance (mode_scan.h).  A mode is determined where the interval reaches at most 0.5
/// % to both sides.  (45.10)
/// @param scan     of the unknowns of the stand alone
/// @param kept     (p) theta of the calibrated case
/// @param highest  Hz
std::vector<PredictedMode> predicted_modes(const FittedStand &stand, const ScannedFit &scan,
                                           const Eigen::VectorXd &kept, double highest);

/// "mode 3, 195.4 Hz (172 .. 221 Hz), is not determined by these records; it depends on K2 and K1", one for each
/// mode that is not determined.
std::vector<std::string> open_mode_words(const std::vector<PredictedMode> &modes);
}  // namespace mill::twin
