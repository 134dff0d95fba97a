#pragma once
#include "twin/spectra/welch.h"
#include <Eigen/Core>

namespace mill::twin {
constexpr double false_alarm =
    1e-3;  ///< -, probability that a channel of noise alone shows a line; theory.md (41.21)

/// Density of the noise under lines and resonances: a low quantile over a third of an octave and 50 bins at least,
/// so that neither a strong line nor a family of lines raises it.  theory.md (41.19)
/// @returns (L/2 + 1) unit^2/Hz.  Cost O(bins).
Eigen::VectorXd noise_floor(const WelchSpectrum &spectrum);

/// Density next to bin k, resonances included: the larger of the two low quantiles over the 3rd to 15th bin to the
/// left and to the right.  theory.md (41.20)
double density_next_to(const Eigen::VectorXd &density, Eigen::Index k, double dof);

/// -, ratio of a chi-square variable to its degrees of freedom that is exceeded with this probability.
/// @param probability  0 .. 1
/// @param dof          > 0
double chi_square_ratio(double probability, double dof);

/// -, density over floor that noise alone exceeds in one or more of `bins` bins with the probability false_alarm.
double detection_threshold(double dof, Eigen::Index bins);
}  // namespace mill::twin
