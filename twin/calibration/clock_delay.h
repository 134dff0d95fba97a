#pragma once
#include "twin/calibration/coarse_start.h"
#include "twin/calibration/fit.h"
#include <string>

// Delay of force and accelerations from two clocks, where it is not an unknown of the fit.  theory.md 44.8
namespace mill::twin {
/// How much later the accelerations are than the force drives them in the stand that was fitted.
struct ClockDelay {
  double seconds   = 0;  ///< s
  double deviation = 0;  ///< s, standard deviation
  double limit     = 0;  ///< s, 1 / (20 high): 18 degrees at the upper end of the band
  /// Is it more than chance and more than a tenth of the limit?
  bool significant() const;
  bool too_large() const;
  /// "the accelerations are 3.02 samples (0.151 ms) later than the force, ..", its uncertainty and the remedy.
  std::string words(double rate) const;
};

/// Where H1 and the fitted stand agree best over +-50 ms, then all unknowns and the delay fitted from there.
/// @param fit  without a delay among its unknowns
/// Cost: one more fit from its own minimum, some ten evaluations of likelihood().
ClockDelay clock_delay(const FittedStand &stand, const Fit &fit, const MeasuredResponse &data,
                       const std::vector<ForcedSamples> &pieces, double rate, double low, double high,
                       const FitSettings &settings);
}  // namespace mill::twin
