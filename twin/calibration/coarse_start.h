#pragma once
#include "twin/calibration/fitted_stand.h"
#include <Eigen/Core>
#include <vector>

namespace mill::twin {
/// Samples of one piece of a record.
struct ForcedSamples {
  Eigen::VectorXd force;         ///< (n) N; empty: not recorded
  Eigen::MatrixXd acceleration;  ///< (n, m) m/s2
};

/// Averages over half-overlapping Hann segments of L samples, one-sided densities.
struct CrossSpectra {
  Eigen::Index L = 0, n = 0;  ///< samples of a segment, segments
  double rate = 0;            ///< Hz
  Eigen::VectorXd force;      ///< (L/2+1) N^2/Hz
  Eigen::MatrixXd response;   ///< (L/2+1, m) (m/s2)^2/Hz
  Eigen::MatrixXcd cross;     ///< (L/2+1, m) m/s2 N/Hz, conj(F) Y
  double averages() const;    ///< -, independent segments: n / (1 + (n - 1)/(18 n))
};

/// n = 0 segments where no piece is that long.
CrossSpectra cross_spectra(const std::vector<ForcedSamples> &pieces, double rate, Eigen::Index L);

/// Where a fit starts: H1 from segments of 2^11 samples, then 2^12 .. 2^15, each fitted from the one before.  The
/// model is seen through the same window, so that short segments widen its resonances as they widen those of the
/// record; the cost has one basin there where that of the whole record has many.  Segments of 2^12 samples are
/// also fitted from steps along each unknown whose prior is wider than 15 %.  theory.md (44.7), (44.8)
/// @return (p) theta
Eigen::VectorXd coarse_start(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                             const std::vector<ForcedSamples> &pieces, const std::vector<Eigen::Index> &places,
                             double rate, double low, double high);
}  // namespace mill::twin
