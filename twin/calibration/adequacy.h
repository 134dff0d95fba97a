#pragma once
#include "twin/calibration/coarse_start.h"
#include "twin/calibration/likelihood.h"
#include <vector>

// Is the model right?  theory.md 45
namespace mill::twin {
/// What a fit leaves in one third octave of one sensor, beside what no linear model with this force explains.
struct BandResidual {
  double centre;        ///< Hz
  Eigen::Index sensor;  ///< from 0; -1: all together
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

/// How many bands are wrong, and the one that exceeds its limit most; null: none.
struct WrongBands {
  int count                 = 0;
  const BandResidual *worst = nullptr;
};
WrongBands wrong_bands(const std::vector<BandResidual> &bands);

/// The part of a third octave that lies in the band that is fitted.
struct ThirdOctave {
  double centre, from, to;  ///< Hz
};
std::vector<ThirdOctave> third_octaves(double low, double high);

/// Samples of the segments of a coherence: 2^16, fewer in a record that does not hold eight of them.
Eigen::Index segment_for(Eigen::Index samples, Eigen::Index longest_piece);

/// @param residual  of the whole pieces, as `data`
/// @param pieces    the same pieces in samples; the coherence comes from segments of 2^16 samples, shorter ones in
///                  a record that does not hold eight of them
std::vector<BandResidual> band_residuals(const MeasuredResponse &data,
                                         const std::vector<Eigen::MatrixXcd> &residual,
                                         const std::vector<ForcedSamples> &pieces, double rate, double low,
                                         double high);
}  // namespace mill::twin
