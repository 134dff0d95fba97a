#pragma once
#include "twin/calibration/force_spectrum.h"
#include "twin/calibration/likelihood.h"

// How well a stand explains accelerations whose force was not recorded.  theory.md 44.5
namespace mill::twin {
/// Accelerations of a stand under one force of unknown course and smooth density.
struct OutputOnly {
  FittedStand stand;
  std::vector<Unknown> unknowns;  ///< (p) of the stand
  MeasuredResponse data;          ///< its force is 1 at every bin: modes answer to one newton
  ForceSpectrum force;
  /// (p + q) those of the stand, then the density of the force at its q knots.
  std::vector<Unknown> all_unknowns() const;
};

/// Records with a unit force in place of the one that is missing.
void set_unit_force(MeasuredResponse &data);

/// -ln of the probability of the accelerations, the force integrated out (44.11): sum ln(1 + S_F h' N^-1 h)
/// + r' S^-1 r with S = S_F h h' + N; ln det N, which no unknown changes, is left out.  `residual` is the second
/// part; with `slopes` and `information` alike the curvature is the expected one without transients.
/// @param theta  (p + q)
/// Cost: 25 ms for 20 s, 880 Hz, two sensors, seven unknowns of the stand; a fifth of it without slopes.
Likelihood output_only_likelihood(const OutputOnly &record, const Eigen::VectorXd &theta,
                                  const NoiseDensity &noise, Wanted wanted, int threads = 1);

/// The force behind one piece as its accelerations show it.
struct SeenForce {
  Eigen::VectorXcd force;     ///< (k) N/sqrt(Hz), mean of what it can have been
  Eigen::VectorXd variance;   ///< (k) N^2/Hz, of that mean
  Eigen::VectorXd density;    ///< (k) N^2/Hz, S_F
  Eigen::MatrixXcd response;  ///< (k, m) 1/kg, h
  Eigen::MatrixXcd left;      ///< (k, m) m/s2/sqrt(Hz), accelerations less transients and h times the force
};
std::vector<SeenForce> seen_force(const OutputOnly &record, const Eigen::VectorXd &theta,
                                  const NoiseDensity &noise);

/// Noise of sensors that are all alike, from what no single force explains at `theta`.
NoiseDensity equal_noise(const OutputOnly &record, const Eigen::VectorXd &theta);

/// Noise of each sensor separately, running means of its expected square (expectation maximisation).  (44.13)
NoiseDensity renewed_noise(const OutputOnly &record, const Eigen::VectorXd &theta, NoiseDensity noise);

/// (p, p) What the same accelerations would tell if the force, as strong as it seems to be, had been recorded.
Eigen::MatrixXd information_with_force(const OutputOnly &record, const Eigen::VectorXd &theta,
                                       const NoiseDensity &noise);
}  // namespace mill::twin
