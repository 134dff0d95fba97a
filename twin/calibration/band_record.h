#pragma once
#include "core/model/record_set.h"
#include "twin/spectra/fourier.h"
#include <Eigen/Core>
#include <vector>

namespace mill::twin {
/// Fourier transform of one whole piece of a record in a band, k bins; scaled so that |.|^2 is a one-sided
/// density.
struct BandRecord {
  double duration = 0;            ///< s
  Eigen::VectorXd angular;        ///< (k) rad/s
  Eigen::VectorXcd force;         ///< (k) N / sqrt(Hz); empty: not recorded
  Eigen::MatrixXcd acceleration;  ///< (k, m) m/s2 / sqrt(Hz)
  /// Between samples of a force that goes in straight lines between them; 0: the force is smooth.  What such a
  /// force holds above half the rate moves the stand too, and the samples fold it back into the band:
  /// modal_columns().
  double line_step = 0;  ///< s
};

/// sin(x)/x of half the angle w step: what straight lines between samples leave of a harmonic is its square.
double sinc_of(double w, double step);

/// No window, no averaging: what the piece carries over from before is taken off by the fit (44.5).
/// Of n samples the first 2^a 3^b 5^c, even, are used (at least 98 % of a long piece), since the transform of a
/// large prime takes hours.
/// @param force         (n) N; empty: not recorded
/// @param acceleration  (n, m) m/s2
/// @param low, high     Hz, bins from `low` to `high`, both included
BandRecord band_record(const Eigen::VectorXd &force, const Eigen::MatrixXd &acceleration, double rate, double low,
                       double high, Fourier &fourier, BetweenSamples between = BetweenSamples::smooth);
}  // namespace mill::twin
