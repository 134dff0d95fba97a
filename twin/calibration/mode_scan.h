#pragma once
#include "twin/calibration/fit.h"
#include <optional>
#include <vector>

// Other places of a resonance that the records hardly show.  theory.md 45.7
namespace mill::twin {
/// Twice the rise of the cost along the frequency of one mode, all unknowns fitted again at each place.
struct ModeScan {
  Eigen::Index mode;                   ///< from 0
  double allowed;                      ///< deviance below which a place is allowed, (45.11)
  Eigen::VectorXd frequency;           ///< (q) rad/s, rising
  Eigen::VectorXd deviance;            ///< (q) -
  std::vector<Eigen::VectorXd> theta;  ///< (q) all unknowns there
  /// Is there an allowed minimum elsewhere?  One minimum alone has the interval of its curvature.
  bool has_several_places() const;
};

/// Minima of a profile between whose and any lower point the curve rises by at least 1.
std::vector<Eigen::Index> minima_of(const Eigen::VectorXd &deviance);

/// Scans each mode up to `highest` whose resonance is so weak that noise elsewhere could look like it: sd of its
/// frequency above a sixth of its half-width.  Walks of one damping ratio a step to 2.5 prior deviations of the
/// frequency on both sides.
/// @param stand_unknowns  those of the problem that move the stand, the first ones
/// @param highest         Hz
/// @param lower           set to the lowest minimum where one is lower than that of the fit by 0.5 of the cost
/// Cost: up to 120 descents a mode.
std::vector<ModeScan> scanned_modes(const FittedStand &stand, const FitProblem &problem, const Fit &fit,
                                    const std::vector<Unknown> &stand_unknowns, double highest,
                                    const FitSettings &settings, std::optional<Eigen::VectorXd> &lower);
}  // namespace mill::twin
