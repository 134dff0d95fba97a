#pragma once
#include "twin/calibration/band_record.h"
#include "twin/calibration/fitted_stand.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// How well a stand explains records of force and accelerations.  theory.md 44
namespace mill::twin {
/// Pieces of records with one force and m sensors each.
struct MeasuredResponse {
  std::vector<BandRecord> pieces;
  std::vector<Eigen::Index> places;  ///< (m) mass of each sensor, from 0
};

/// (pieces) (k, m) (m/s2)^2/Hz, one-sided density of the noise of each bin and sensor.
using NoiseDensity = std::vector<Eigen::MatrixXd>;

/// Cost and what its minimum needs, at one theta.
struct Likelihood {
  double cost     = 0;          ///< sum |r|^2/N + 1/2 sum ((theta - prior)/sd)^2  (44.4)
  double residual = 0;          ///< its first part
  Eigen::MatrixXd transient;    ///< (2 n, pieces) alpha_i, beta_i of (44.5)
  Eigen::VectorXd slope;        ///< (p) of the cost; empty: not asked for
  Eigen::MatrixXd information;  ///< (p, p) A = 2 Re J'J/N, transients eliminated, without the prior; empty: not
                                ///< asked for
};

/// Adds 1/2 ((theta - prior)/sd)^2 to the cost and its slope.
void add_prior(Likelihood &sum, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta);

enum class Wanted {
  cost,
  slopes,      ///< of all that follows theta, what rings on included: for descents
  information  ///< of what the recorded force explains alone; slope is not the cost's then.  Ringing that is
               ///< fitted to noise follows every resonance and would claim to know it.  (44.6)
};

/// Cost: 12 ms for 20 s, 880 Hz, two sensors, seven unknowns; a fifth of it without slopes; one thread.
/// The outcome does not depend on the number of threads.
Likelihood likelihood(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta,
                      const MeasuredResponse &data, const NoiseDensity &noise, Wanted wanted, int threads = 1);

/// (pieces) (k, m) m/s2/sqrt(Hz), what the stand and the best transients leave.
std::vector<Eigen::MatrixXcd> residuals(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                                        const Eigen::VectorXd &theta, const MeasuredResponse &data,
                                        const NoiseDensity &noise);

/// Running mean of |r|^2 over +-200 bins, fewer at the ends and in short pieces.  (44.6)
NoiseDensity noise_of(const std::vector<Eigen::MatrixXcd> &residuals);

/// Noise for a first step: running mean of the accelerations themselves.
NoiseDensity noise_before(const MeasuredResponse &data);
}  // namespace mill::twin
