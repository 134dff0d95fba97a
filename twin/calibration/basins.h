#pragma once
#include "twin/calibration/fit.h"
#include "twin/calibration/mode_scan.h"
#include <functional>
#include <string>
#include <vector>

// Other minima than the first one, and intervals where the cost is not a parabola.  theory.md 44
namespace mill::twin {
/// Twice the rise of the cost over its minimum along one unknown, all others fitted again.
struct Profile {
  std::string name;
  Eigen::VectorXd theta;     ///< (17) 2.5 prior sd to both sides of the prior
  Eigen::VectorXd deviance;  ///< (17) -
};

/// A minimum of its own on a profile.
struct Basin {
  std::string name;          ///< of the unknown that was scanned
  double theta;              ///< of that unknown
  double deviance;           ///< over the lowest minimum
  Eigen::VectorXd unknowns;  ///< (p) of all, there
};

struct ScannedFit {
  Fit best;                           ///< the lowest minimum of all
  std::vector<Profile> profiles;      ///< of springs whose sd is more than 0.01 of the prior's
  std::vector<Basin> basins;          ///< other minima with a deviance below 100, lowest first
  Eigen::MatrixXd interval;           ///< (p, 2) theta, 95 %: deviance 3.84 of scanned springs, else 1.96 sd
  std::vector<Eigen::VectorXd> ends;  ///< (p) all unknowns at the ends of the intervals that profiles gave
  int starts_over             = 0;    ///< how often a scan found a lower minimum and all began again
  std::vector<ModeScan> modes = {};   ///< of modes that the records hardly show
};

/// Intervals of the best fit: by profiles of the springs that were scanned.
void set_intervals(const FitProblem &problem, const FitSettings &settings, ScannedFit &scan);

/// Scans around a fit: each spring with sd > 0.01 prior sd over +-2.5 prior sd in 17 steps, walked from both ends,
/// each step fitted from the one before.  A lower minimum replaces the fit (noise renewed) and is scanned again,
/// at most three times. Cost: some 250 descents; 5 s for 20 s, two sensors, seven unknowns, on two threads.
/// @param progress  called with the fraction done
ScannedFit scanned(const FitProblem &problem, const Fit &first, const FitSettings &settings,
                   const std::function<void(double)> &progress = {});
ScannedFit scanned(const FittedStand &stand, const Fit &first, const MeasuredResponse &data,
                   const FitSettings &settings, const std::function<void(double)> &progress = {});
}  // namespace mill::twin
