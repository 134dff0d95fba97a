#include "twin/calibration/fit.h"
#include "twin/calibration/grouped_response.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {

Eigen::VectorXd prior_weight(const std::vector<Unknown> &unknowns)
{
  Eigen::VectorXd w(Eigen::Index(unknowns.size()));
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    w[Eigen::Index(i)] = 1 / (unknowns[i].prior_sd * unknowns[i].prior_sd);
  return w;
}

/// -(curvature + lambda diag)^-1 slope; the fixed unknown does not move.
Eigen::VectorXd step_of(Eigen::MatrixXd curvature, Eigen::VectorXd slope, const double lambda,
                        const Eigen::Index fixed)
{
  curvature.diagonal() *= 1 + lambda;
  if (fixed >= 0) {
    curvature.row(fixed).setZero();
    curvature.col(fixed).setZero();
    curvature(fixed, fixed) = 1;
    slope[fixed]            = 0;
  }
  const Eigen::VectorXd scale = curvature.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd even  = scale.asDiagonal() * curvature * scale.asDiagonal();
  return -(scale.asDiagonal() * even.ldlt().solve(scale.asDiagonal() * slope));
}

}  // namespace

Eigen::MatrixXd posterior_covariance(const Eigen::MatrixXd &information, const std::vector<Unknown> &unknowns)
{
  const Eigen::MatrixXd curvature = information + Eigen::MatrixXd(prior_weight(unknowns).asDiagonal());
  const Eigen::VectorXd scale     = curvature.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd even      = scale.asDiagonal() * curvature * scale.asDiagonal();
  return scale.asDiagonal() * even.ldlt().solve(Eigen::MatrixXd::Identity(even.rows(), even.cols())).eval() *
         scale.asDiagonal();
}

double number_of_values(const MeasuredResponse &data)
{
  double n = 0;
  for (const BandRecord &band : data.pieces)
    n += double(band.acceleration.size());
  return n;
}

Eigen::VectorXd Fit::sd() const
{
  return covariance.diagonal().cwiseSqrt();
}

Eigen::VectorXd Fit::shrink() const
{
  Eigen::VectorXd s = sd();
  for (Eigen::Index i = 0; i < s.size(); ++i)
    s[i] /= unknowns[std::size_t(i)].prior_sd;
  return s;
}

Descent descend(const Objective &objective, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &start,
                const int most_steps, const double decrease, const Eigen::Index fixed)
{
  const Eigen::VectorXd weight = prior_weight(unknowns);
  Descent descent{start, objective(start, Wanted::slopes), 0, false};
  double lambda = 1e-3;
  for (; descent.steps < most_steps && !descent.converged; ++descent.steps) {
    const Likelihood &here          = descent.likelihood;
    const Eigen::MatrixXd curvature = here.information + Eigen::MatrixXd(weight.asDiagonal());
    const Eigen::VectorXd step      = step_of(curvature, here.slope, lambda, fixed);
    const double foreseen           = -here.slope.dot(step) - 0.5 * step.dot(curvature * step);
    if (!(foreseen > decrease)) {
      descent.converged = lambda < 1;  // a step made short by lambda says nothing about the minimum
      lambda *= 0.1;
      continue;
    }
    // e^1 is further than any basin reaches: a longer step comes from a direction the records hardly show
    const double longest       = step.cwiseAbs().maxCoeff();
    const Eigen::VectorXd next = descent.theta + step * std::min(1.0, 1.0 / longest);
    Likelihood there           = objective(next, Wanted::cost);
    if (there.cost < here.cost) {
      if (there.slope.size() == 0)
        there = objective(next, Wanted::slopes);
      descent.converged  = here.cost - there.cost < decrease && lambda < 1;
      descent.theta      = next;
      descent.likelihood = std::move(there);
      lambda             = std::max(1e-9, 0.1 * lambda);
    } else {
      lambda = std::max(1e-3, 10 * lambda);
      if (lambda > 1e9)
        break;
    }
  }
  return descent;
}

FitProblem recorded_force(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                          const MeasuredResponse &data)
{
  FitProblem problem;
  problem.unknowns   = unknowns;
  problem.is_spring  = [&stand](const std::string &name) { return moves_springs(stand, name); };
  problem.likelihood = [&stand, &data, unknowns](const Eigen::VectorXd &theta, const NoiseDensity &noise,
                                                 const Wanted wanted, const int threads) {
    return likelihood(stand, unknowns, theta, data, noise, wanted, threads);
  };
  problem.grouped = [&stand, &data, unknowns](const Eigen::VectorXd &theta, const NoiseDensity &noise) {
    return [&stand, unknowns, groups = grouped(stand, unknowns, theta, data, noise)](
               const Eigen::VectorXd &trial, const NoiseDensity &, const Wanted wanted, const int threads) {
      return likelihood(stand, unknowns, trial, groups.data, groups.noise, wanted, threads);
    };
  };
  problem.renewed = [&stand, &data, unknowns](const Eigen::VectorXd &theta, const NoiseDensity &noise) {
    return noise_of(residuals(stand, unknowns, theta, data, noise));
  };
  problem.before = noise_before(data);
  problem.values = number_of_values(data);
  return problem;
}

Fit minimised(const FitProblem &problem, const Eigen::VectorXd &start, const NoiseDensity &noise,
              const FitSettings &settings, const Eigen::Index fixed)
{
  const Descent descent =
      descend([&](const Eigen::VectorXd &theta,
                  const Wanted wanted) { return problem.likelihood(theta, noise, wanted, settings.threads); },
              problem.unknowns, start, settings.steps, settings.decrease, fixed);
  Fit fit;
  fit.unknowns  = problem.unknowns;
  fit.estimate  = descent.theta;
  fit.steps     = descent.steps;
  fit.converged = descent.converged;
  fit.cost      = descent.likelihood.cost;
  fit.misfit    = descent.likelihood.residual / problem.values;
  fit.noise     = noise;
  if (!settings.covariance)
    return fit;
  fit.information = problem.likelihood(descent.theta, noise, Wanted::information, settings.threads).information;
  fit.covariance  = posterior_covariance(fit.information, problem.unknowns);
  return fit;
}

Fit minimised(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &start,
              const MeasuredResponse &data, const NoiseDensity &noise, const FitSettings &settings,
              const Eigen::Index fixed)
{
  return minimised(recorded_force(stand, unknowns, data), start, noise, settings, fixed);
}

Fit fitted(const FitProblem &problem, const Eigen::VectorXd &start, const FitSettings &settings)
{
  Fit fit;
  Eigen::VectorXd theta = start;
  NoiseDensity noise    = problem.before;
  int steps             = 0;
  bool converged        = true;
  for (int round = 0; round <= settings.renewals; ++round) {
    noise = problem.renewed(theta, noise);
    fit   = minimised(problem, theta, noise, settings);
    theta = fit.estimate;
    steps += fit.steps;
    converged = fit.converged;
  }
  fit.steps     = steps;
  fit.converged = converged;
  return fit;
}

Fit fitted(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &start,
           const MeasuredResponse &data, const FitSettings &settings)
{
  return fitted(recorded_force(stand, unknowns, data), start, settings);
}

NoiseDensity carried_noise(const NoiseDensity &noise, const MeasuredResponse &from, const MeasuredResponse &to)
{
  // The longest piece says the noise best.
  std::size_t longest = 0;
  for (std::size_t i = 0; i < from.pieces.size(); ++i)
    if (from.pieces[i].angular.size() > from.pieces[longest].angular.size())
      longest = i;
  const Eigen::VectorXd &known = from.pieces[longest].angular;
  NoiseDensity carried;
  for (const BandRecord &band : to.pieces) {
    Eigen::MatrixXd there(band.angular.size(), band.acceleration.cols());
    for (Eigen::Index b = 0; b < there.rows(); ++b) {
      const auto row = std::lower_bound(known.data(), known.data() + known.size(), band.angular[b]) - known.data();
      there.row(b)   = noise[longest].row(std::min<Eigen::Index>(row, known.size() - 1));
    }
    carried.push_back(std::move(there));
  }
  return carried;
}

double misfit_on(const FittedStand &stand, const std::vector<Unknown> &unknowns, const Eigen::VectorXd &theta,
                 const MeasuredResponse &data, const MeasuredResponse &fit_data, const NoiseDensity &noise)
{
  return likelihood(stand, unknowns, theta, data, carried_noise(noise, fit_data, data), Wanted::cost).residual /
         number_of_values(data);
}
}  // namespace mill::twin
