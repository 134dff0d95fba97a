#include "reduce/bite/fit/fit.h"
#include "core/base/errors.h"
#include "reduce/bite/sentence.h"
#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::bite {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

bool within_bounds(const FitProblem &problem, const VectorXd &x)
{
  for (std::size_t j = 0; j < problem.unknowns.size(); ++j) {
    const double x_j  = x[Index(j)];
    const double high = largest_log_factor(problem.passes.front().bite.strip, problem.unknowns[j]);
    if (!(x_j <= high && x_j >= -std::log(20.)))
      return false;
  }
  return true;
}

/// Residuals at x; throws what a pass says where it does not exist.
FitPoint point_at(const FitProblem &problem, const VectorXd &x, const bool slopes)
{
  const auto data = data_of(problem);
  const Index m = Index(data.size()), n = x.size();
  FitPoint point;
  point.x        = x;
  point.residual = VectorXd(m);
  point.slope    = MatrixXd(slopes ? m : 0, n);
  PredictedPass predicted;
  std::size_t predicted_for = problem.passes.size();
  for (Index i = 0; i < m; ++i) {
    const FitDatum &datum    = data[std::size_t(i)];
    const MeasuredPass &pass = problem.passes[datum.pass];
    const std::size_t kind   = std::size_t(datum.kind);
    if (datum.pass != predicted_for)
      predicted = predict_pass(pass.bite, problem.arc, problem.unknowns, x, slopes);
    predicted_for     = datum.pass;
    const double y    = pass.factor[kind] * predicted.value[Index(kind)] + pass.shift[kind];
    point.residual[i] = (y - pass.value[kind]) / pass.deviation[kind];
    if (slopes)
      point.slope.row(i) = pass.factor[kind] / pass.deviation[kind] * predicted.by.row(Index(kind));
  }
  point.misfit = point.residual.squaredNorm();
  return point;
}

/// Steps of Levenberg and Marquardt over the unknowns that are free.
struct Descent {
  const FitProblem &problem;
  FitPoint point;
  bool refused = false;  ///< the last step was shortened to nothing by passes that do not exist

  VectorXd step(const std::vector<bool> &held, const double damping) const
  {
    const Index n = point.x.size();
    MatrixXd A    = point.slope.transpose() * point.slope;
    VectorXd b    = -point.slope.transpose() * point.residual;
    A.diagonal() *= 1 + damping;
    for (Index j = 0; j < n; ++j)
      if (held[std::size_t(j)] || A(j, j) == 0) {
        A.row(j).setZero();
        A.col(j).setZero();
        A(j, j) = 1;
        b[j]    = 0;
      }
    VectorXd step            = A.ldlt().solve(b);
    constexpr double longest = 0.5;  // a factor of 1.6 in one step
    const double length      = step.cwiseAbs().maxCoeff();
    return length > longest ? VectorXd(step * (longest / length)) : step;
  }

  /// True where nothing is left to gain.
  bool settle(const std::vector<bool> &held)
  {
    double damping = 1e-4;
    refused        = false;
    for (int i = 0; i < 200; ++i) {
      const VectorXd step = this->step(held, damping);
      if (step.cwiseAbs().maxCoeff() < 1e-10)
        return !refused;
      auto next = fit_point(problem, point.x + step);
      if (!next || !(next->misfit < point.misfit)) {
        refused = !next;
        damping *= next ? 10 : 4;
        // Where the descent is below the rounding of the integration there is nothing left to gain.
        if (next && next->misfit - point.misfit < 1e-9 * (1 + point.misfit) && step.cwiseAbs().maxCoeff() < 1e-6)
          return true;
        if (damping > 1e12)
          return !refused;
        continue;
      }
      const double gain = point.misfit - next->misfit;
      refused           = false;
      point             = std::move(*next);
      damping           = std::max(1e-12, damping / 10);
      if (gain < 1e-12 * (1 + point.misfit))
        return true;
    }
    return false;
  }
};
}  // namespace

std::vector<FitDatum> data_of(const FitProblem &problem)
{
  std::vector<FitDatum> data;
  for (std::size_t p = 0; p < problem.passes.size(); ++p)
    for (std::size_t kind = 0; kind < n_measured; ++kind)
      if (!std::isnan(problem.passes[p].value[kind]))
        data.push_back({p, Measured(kind)});
  return data;
}

std::optional<FitPoint> fit_point(const FitProblem &problem, const VectorXd &x, const bool slopes)
{
  if (!within_bounds(problem, x))
    return std::nullopt;
  try {
    return point_at(problem, x, slopes);
  } catch (const InputError &) {
  } catch (const SolverError &) {
  }
  return std::nullopt;
}

FitPoint feasible_start(const FitProblem &problem)
{
  using Role      = FitUnknown::Role;
  const Index n   = Index(problem.unknowns.size());
  const auto from = [&](const Role role, const double shift) -> std::optional<FitPoint> {
    VectorXd x = VectorXd::Zero(n);
    for (Index j = 0; j < n; ++j)
      if (problem.unknowns[std::size_t(j)].role == role)
        x[j] = shift;
    return x.isZero() ? std::nullopt : fit_point(problem, x);
  };
  if (auto point = fit_point(problem, VectorXd::Zero(n)))
    return *point;
  // More friction where the rolls skid, less of either where they flatten without limit.
  for (const Role role : {Role::friction, Role::flow_stress, Role::constant})
    for (double shift = 0.1; shift < 3; shift += 0.1)
      for (const double sign : {1., -1.})
        if (auto point = from(role, sign * shift))
          return *point;
  return point_at(problem, VectorXd::Zero(n), true);  // throws what the pass says
}

FitPoint least_misfit(const FitProblem &problem, const FitPoint &start, const std::vector<bool> &held)
{
  Descent descent{problem, start};
  std::vector<bool> still = held;
  bool edge               = false;
  for (std::size_t round = 0; round <= problem.unknowns.size(); ++round) {
    if (descent.settle(still))
      break;
    if (!descent.refused)
      throw SolverError({"fit of the bite: no least misfit",
                         sentence("sum of squares ", descent.point.misfit, " after 200 steps"),
                         "measured values that no friction and no flow stress explain",
                         "fewer numbers in bite.fit_for, or measured values that agree", ""});
    // The minimum lies beyond where passes exist: what leads there stays, the others go on.
    edge = true;
    Index worst;
    const VectorXd step = descent.step(still, 0).cwiseAbs();
    step.maxCoeff(&worst);
    if (still[std::size_t(worst)])
      break;
    still[std::size_t(worst)] = true;
  }
  descent.point.at_edge = edge;
  return descent.point;
}

FitPoint least_misfit(const FitProblem &problem, const FitPoint &start)
{
  return least_misfit(problem, start, std::vector<bool>(problem.unknowns.size(), false));
}

std::vector<FitDirection> directions_of(const FitPoint &point)
{
  const Index n = point.x.size();
  const Eigen::JacobiSVD<MatrixXd> svd(point.slope, Eigen::ComputeFullV);
  const VectorXd &values = svd.singularValues();
  std::vector<FitDirection> all;
  for (Index j = n - 1; j >= 0; --j) {
    FitDirection direction;
    direction.unit = svd.matrixV().col(j);
    Index largest;
    direction.unit.cwiseAbs().maxCoeff(&largest);
    if (direction.unit[largest] < 0)
      direction.unit *= -1;
    const double value  = j < values.size() ? values[j] : 0;
    direction.deviation = value > 1e-10 * values[0] ? 1 / value : std::numeric_limits<double>::infinity();
    all.push_back(std::move(direction));
  }
  return all;
}

MatrixXd covariance_of(const FitPoint &point)
{
  const Index n       = point.x.size();
  MatrixXd covariance = MatrixXd::Zero(n, n);
  for (const FitDirection &d : directions_of(point))
    covariance += d.deviation * d.deviation * d.unit * d.unit.transpose();
  return covariance;
}
}  // namespace mill::bite
