#pragma once
#include "twin/calibration/coarse_start.h"
#include "twin/calibration/likelihood.h"
#include <Eigen/Core>
#include <vector>

// Averaged spectra of a record against a stand that is seen through their window.  theory.md (44.7), (44.8)
namespace mill::twin {
/// H1 of one length of segment with its variance.
struct AveragedResponse {
  Eigen::Index first = 0;    ///< bin
  double bin         = 0;    ///< rad/s
  Eigen::MatrixXcd H;        ///< (k, m) 1/kg
  Eigen::MatrixXd variance;  ///< (k, m) 1/kg^2
};

/// Bins between two frequencies [Hz]; two and more of a segment.
AveragedResponse averaged_response(const CrossSpectra &spectra, double low, double high);

/// A stand and its unknowns against averaged spectra.
struct WindowedFit {
  const FittedStand &stand;
  const std::vector<Unknown> &unknowns;
  const std::vector<Eigen::Index> &places;  ///< (m)
  const AveragedResponse &measured;
  BandRecord fine;          ///< fine_grid() of the bins
  Eigen::VectorXd weights;  ///< hann_weights()

  /// Sum of |H - model|^2 over the variance, and the prior.
  Likelihood squares(const Eigen::VectorXd &theta, Wanted wanted) const;
  /// Sum of (ln |H| - ln |model|)^2 over the variance of ln |H| plus 0.3^2, and the prior.  A resonance at a wrong
  /// frequency costs its distance there and not its height, so that the basins are wide.
  Likelihood logarithms(const Eigen::VectorXd &theta, Wanted wanted) const;
};

WindowedFit windowed_fit(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                         const std::vector<Eigen::Index> &places, const AveragedResponse &measured);
}  // namespace mill::twin
