#pragma once
#include "twin/calibration/coarse_start.h"
#include "twin/calibration/likelihood.h"
#include <vector>

// Is the model right?  theory.md 45
namespace mill::twin {
constexpr double usual_model_error = 0.05;  ///< -, of the level of a third octave, that a model may be wrong by
constexpr double least_energy      = 0.01;  ///< -, share of the energy below which a band refuses nothing

/// Residual of a fit in one third octave of one sensor, compared with the share that no linear model with this
/// force explains and with the model error.
struct BandResidual {
  double centre;        ///< Hz
  Eigen::Index sensor;  ///< from 0; -1: all together
  Eigen::Index bins;    ///< of the whole record's transform
  double energy;        ///< -, share of the sensor's energy in the whole band
  double left;          ///< -, share of the band's energy that the fit leaves
  double floor;         ///< -, 1 - coherence, unbiased: share that no linear model explains
  double ratio;         ///< -, left / (floor + model error^2)
  double limit;         ///< -, 1.05 + 4 / sqrt(bins)
  bool decisive;        ///< a linear model explains a tenth, and the band holds 1 % of the energy
  bool wrong() const
  {
    return decisive && ratio > limit;
  }
};

/// Number of bands above their limit, and the one that exceeds its limit most; null: no band does.
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

/// @param residual     of the whole pieces, as `data`
/// @param pieces       the same pieces in samples; the coherence comes from segments of 2^16 samples, shorter ones
///                     in a record that does not hold eight of them
/// @param model_error  -, of the level of each third octave, that the model may be wrong by
std::vector<BandResidual> band_residuals(const MeasuredResponse &data,
                                         const std::vector<Eigen::MatrixXcd> &residual,
                                         const std::vector<ForcedSamples> &pieces, double rate, double low,
                                         double high, double model_error = usual_model_error);
}  // namespace mill::twin
