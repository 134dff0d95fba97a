#pragma once
#include "twin/calibration/likelihood.h"
#include <functional>

namespace mill::twin {
struct FitSettings {
  int renewals    = 3;  ///< how often the noise is taken from the residuals again
  int steps       = 60;
  double decrease = 1e-4;  ///< of the cost, at which a minimum is reached: 1/70 of a standard deviation
  int threads     = 1;
  bool covariance = true;  ///< also information and covariance, which walks do not need
};

/// What records say about the unknowns.
struct Fit {
  std::vector<Unknown> unknowns;
  Eigen::VectorXd estimate;     ///< (p) theta, ln of factors on the case
  Eigen::MatrixXd covariance;   ///< (p, p) (A + 1/prior_sd^2)^-1; sd = roots of its diagonal
  Eigen::MatrixXd information;  ///< (p, p) A, of the records alone
  NoiseDensity noise;
  double cost   = 0;       ///< at the estimate, with `noise`
  double misfit = 0;       ///< mean of |r|^2 over the noise it was weighed with; near 1 unless the noise came from
                           ///< elsewhere
  int steps      = 0;      ///< of all minimisations
  bool converged = false;  ///< every one of them
  Eigen::VectorXd sd() const;      ///< (p)
  Eigen::VectorXd shrink() const;  ///< (p) sd over prior sd
};

/// (p, p) (A + diag 1/prior_sd^2)^-1
Eigen::MatrixXd posterior_covariance(const Eigen::MatrixXd &information, const std::vector<Unknown> &unknowns);

/// Cost of theta and, where they are wanted, slope and curvature; one that always gives all may.
using Objective = std::function<Likelihood(const Eigen::VectorXd &theta, Wanted wanted)>;
struct Descent {
  Eigen::VectorXd theta;
  Likelihood likelihood;
  int steps;
  bool converged;
};
/// Levenberg and Marquardt, until the cost falls by less than `decrease`.
/// @param fixed  index of an unknown that stays at its start; -1: none
Descent descend(const Objective &objective, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &start,
                int most_steps, double decrease, Eigen::Index fixed = -1);

using LikelihoodOf =
    std::function<Likelihood(const Eigen::VectorXd &theta, const NoiseDensity &noise, Wanted wanted, int threads)>;

/// What is fitted: how records weigh theta, with and without a recorded force.
struct FitProblem {
  std::vector<Unknown> unknowns;
  std::function<bool(const std::string &unknown)> is_spring;  ///< whose minima are looked for
  LikelihoodOf likelihood;
  /// The likelihood of neighbouring bins as one (grouped_response.h), for walks around theta; it keeps the noise
  /// that it was made with.  Empty: `likelihood` serves.
  std::function<LikelihoodOf(const Eigen::VectorXd &theta, const NoiseDensity &noise)> grouped;
  /// Noise that what is left at theta shows, weighed with `noise` until then.
  std::function<NoiseDensity(const Eigen::VectorXd &theta, const NoiseDensity &noise)> renewed;
  NoiseDensity before;  ///< noise for the first renewal
  double values = 0;    ///< complex numbers that are weighed
};

/// Records whose force was recorded.  `stand` and `data` stay where they are while the problem is used.
FitProblem recorded_force(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                          const MeasuredResponse &data);

/// One minimisation with fixed noise.
/// @param fixed  index of an unknown that stays at its start; -1: none
Fit minimised(const FitProblem &problem, const Eigen::VectorXd &start, const NoiseDensity &noise,
              const FitSettings &settings = {}, Eigen::Index fixed = -1);
Fit minimised(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &start,
              const MeasuredResponse &data, const NoiseDensity &noise, const FitSettings &settings = {},
              Eigen::Index fixed = -1);

/// From `start`: noise from the residuals there, minimised, noise renewed, minimised, ..
/// The minimum next to the start; other basins: basins.h.  Cost: some 20 evaluations of the likelihood.
Fit fitted(const FitProblem &problem, const Eigen::VectorXd &start, const FitSettings &settings = {});
Fit fitted(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &start,
           const MeasuredResponse &data, const FitSettings &settings = {});

/// Noise of one record for the bins of another, carried over by frequency.
NoiseDensity carried_noise(const NoiseDensity &noise, const MeasuredResponse &from, const MeasuredResponse &to);

/// Complex accelerations of all pieces and sensors.
double number_of_values(const MeasuredResponse &data);

/// Mean of |r|^2 over the noise that another record left, carried over by frequency: 1 where the stand explains
/// this record as well.  theory.md 45.3
/// @param noise  of `fit_data`, all pieces with one set of sensors
double misfit_on(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta,
                 const MeasuredResponse &data, const MeasuredResponse &fit_data, const NoiseDensity &noise);
}  // namespace mill::twin
