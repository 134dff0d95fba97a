#pragma once
#include "twin/calibration/likelihood.h"

// Fewer bins of a record where resonances are wide, for walks that need the shape of the cost only.
namespace mill::twin {
struct GroupedResponse {
  MeasuredResponse data;
  NoiseDensity noise;  ///< (pieces) (groups, m)
};

/// Neighbouring bins as one, 16 at most, so that the half-width of a resonance at that frequency holds eight
/// groups: Y_g = sum F* (Y - ringing)/sqrt(sum |F|^2) under the force sqrt(sum |F|^2).  Where the response to the
/// force does not change within a group nothing is lost: residuals have the noise of a single bin, and the cost
/// differs from that of all bins by a constant.  What rings on from before the piece is taken off as `theta`
/// leaves it.  (44.9a) Cost: two evaluations of the likelihood.
GroupedResponse grouped(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                        const Eigen::VectorXd &theta, const MeasuredResponse &data, const NoiseDensity &noise);
}  // namespace mill::twin
