#pragma once
#include "twin/calibration/fitted_stand.h"
#include <Eigen/Core>
#include <vector>

// The density of a force that was not recorded.  theory.md 44.5
namespace mill::twin {
/// ln S_F is linear in ln f between knots, three in an octave; at the knots it is unknown.  So a force may fall
/// and rise over the band, yet not within the width of a resonance: that is what tells damping without a force.
struct ForceSpectrum {
  double level = 1;       ///< N^2/Hz, one-sided density where the unknowns of all knots are zero
  Eigen::VectorXd knots;  ///< (q) Hz, ascending; the first and the last are the ends of the band
};

ForceSpectrum force_spectrum(double low, double high);

/// ln of the density over the level at each knot.  Nobody knows it: sd 3, a factor of 20.
std::vector<Unknown> unknowns_of(const ForceSpectrum &spectrum);

/// Between which knots a frequency lies.
struct BetweenKnots {
  Eigen::Index below;  ///< knot; the next one is above
  double share;        ///< -, 0 at the lower, 1 at the upper knot
};
BetweenKnots between_knots(const ForceSpectrum &spectrum, double frequency);

/// N^2/Hz.
/// @param at_knots  (q) ln of the density over the level
double density(const ForceSpectrum &spectrum, const Eigen::VectorXd &at_knots, double frequency);
}  // namespace mill::twin
