#pragma once
#include "twin/calibration/coarse_start.h"
#include "twin/calibration/output_only.h"

// Where a fit without a recorded force starts.  theory.md 44.6
namespace mill::twin {
/// Averages over half-overlapping Hann segments of L samples: cross spectra of all sensors with each other.
struct SpectralMatrices {
  Eigen::Index L = 0, n = 0;              ///< samples of a segment, segments
  double rate = 0;                        ///< Hz
  std::vector<Eigen::MatrixXcd> density;  ///< (L/2+1) (m, m) (m/s2)^2/Hz, Y Y'
  double averages() const;                ///< -, independent segments, as CrossSpectra
};

/// n = 0 segments where no piece is that long.
SpectralMatrices spectral_matrices(const std::vector<ForcedSamples> &pieces, double rate, Eigen::Index L);

/// Start of springs, damping and density of the force: spectral matrices from segments of 2^11 samples, then 2^12
/// .. 2^15, each fitted from the one before, with the model seen through the same window.  (44.14)
/// @param record  its force.level is set to what the first of these fits needs on average
/// @return (p + q) theta
Eigen::VectorXd output_only_start(OutputOnly &record, const std::vector<ForcedSamples> &pieces, double rate,
                                  double low, double high);
}  // namespace mill::twin
