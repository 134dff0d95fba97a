#pragma once
#include "twin/spectra/welch.h"
#include <vector>

namespace mill::twin {
/// A peak of a spectrum.
struct Peak {
  double frequency;   ///< Hz, or 1/m over the rolled length; of a line between its bins
  double amplitude;   ///< unit, 0-peak, of a line; of a resonance root 2 times the rms within its half-power band
  double density;     ///< unit^2/Hz, at the highest bin
  double prominence;  ///< dB over the median of the 120 neighbours
  double width;       ///< Hz, between half-power points
  bool line;          ///< narrower than 1.6 equivalent noise bandwidths, and steady from segment to segment
  Eigen::Index bin;
  double resolution;     ///< Hz, of the spectrum it was found in
  double deviation = 0;  ///< Hz, standard deviation of the frequency; 0: not computed
  double coherence = 0;  ///< -, share of the power that turns steadily over the record
  double swing     = 0;  ///< -, variance of the power from segment to segment over its mean squared
};

/// Bins that stand 10 dB over the median of their 120 neighbours, and higher than noise does once in 1e9 bins; of
/// several within the skirt of a higher one only those that stand out of that skirt as much.  Highest first.
/// @param low, high  Hz, where to look
std::vector<Peak> peaks(const WelchSpectrum &spectrum, double low, double high);
}  // namespace mill::twin
