#pragma once
#include "twin/calibration/coarse_start.h"
#include "twin/calibration/likelihood.h"
#include <vector>

// Is the model right?  theory.md 45
namespace mill::twin {
/// What a fit leaves in one third octave of one sensor, beside what no linear model with this force explains.
struct BandResidual {
  double centre;        ///< Hz
  Eigen::Index sensor;  ///< from 0
  Eigen::Index bins;    ///< of the whole record's transform
  double energy;        ///< -, share of the sensor's energy in the whole band
  double left;          ///< -, share of the band's energy that the fit leaves
  double floor;         ///< -, 1 - coherence, unbiased: share that no linear model explains
  double ratio;         ///< -, left / floor
  double limit;         ///< -, 1.05 + 4 / sqrt(bins)
  bool counts;          ///< a linear model explains a tenth
  bool wrong() const
  {
    return counts && ratio > limit;
  }
};

/// @param residual  of the whole pieces, as `data`
/// @param pieces    the same pieces in samples; the coherence comes from segments of 2^16 samples, shorter ones in
///                  a record that does not hold eight of them
std::vector<BandResidual> band_residuals(const MeasuredResponse &data,
                                         const std::vector<Eigen::MatrixXcd> &residual,
                                         const std::vector<ForcedSamples> &pieces, double rate, double low,
                                         double high);
}  // namespace mill::twin
