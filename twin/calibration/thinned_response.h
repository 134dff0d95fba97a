#pragma once
#include "twin/calibration/likelihood.h"
#include <Eigen/Core>
#include <vector>

// Fewer bins of a record where resonances are wide, for searches that need the shape of the cost only.
namespace mill::twin {
struct ThinnedResponse {
  MeasuredResponse data;
  std::vector<std::vector<Eigen::Index>> bins;  ///< (pieces) of the whole record
  std::vector<Eigen::VectorXd> stands_for;      ///< (pieces) (k) bins of the whole record that one bin stands for
};

/// Every n-th bin, at most every 16th, so that the half-width of a resonance at that frequency holds four of them.
/// @param damping  -, of the narrowest resonance
ThinnedResponse thinned(const MeasuredResponse &data, double damping);

/// Noise of the bins that are left, less by the number of bins that each stands for: the cost has the size of the
/// whole record's.
NoiseDensity thinned(const NoiseDensity &noise, const ThinnedResponse &thin);
}  // namespace mill::twin
