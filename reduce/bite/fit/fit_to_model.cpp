#include "reduce/bite/fit/fit_to_model.h"
#include "core/base/errors.h"
#include "reduce/bite/fit/identify.h"
#include "reduce/bite/sentence.h"
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace mill::bite {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_rounds = 20;
constexpr double settled  = 0.01;  // standard deviations of a measured value

// A torque near zero has no ratio.
bool has_ratio(const double value, const double slab)
{
  const double ratio = value / slab;
  return ratio > 0.3 && ratio < 3;
}

// Makes the corrected slab equal to the model at x, (31.7).
void correct_slab(FitProblem &problem, const VectorXd &x, const std::vector<Eigen::Vector3d> &by_model)
{
  for (std::size_t p = 0; p < problem.passes.size(); ++p) {
    MeasuredPass &pass = problem.passes[p];
    if (std::all_of(pass.value.begin(), pass.value.end(), [](const double y) { return std::isnan(y); }))
      continue;
    const auto by_slab = predict_pass(pass.bite, problem.arc, problem.unknowns, x, false).value;
    for (std::size_t kind = 0; kind < n_measured; ++kind) {
      if (std::isnan(pass.value[kind]))
        continue;
      const double slab = by_slab[Index(kind)], value = by_model[p][Index(kind)];
      const bool ratio  = kind != std::size_t(Measured::slip) && has_ratio(value, slab);
      pass.factor[kind] = ratio ? value / slab : 1;
      pass.shift[kind]  = ratio ? 0 : value - slab;
    }
  }
}

// Points of the rounds and the steps that the fits of the corrected slab wanted from them.
struct Rounds {
  std::vector<VectorXd> x, step;

  // The point where, by the differences of the last rounds, the wanted step vanishes, (31.8).
  VectorXd extrapolated() const
  {
    const Index used     = std::min<Index>(Index(x.size()) - 1, x.back().size());
    const VectorXd plain = x.back() + step.back();
    if (used == 0)
      return plain;
    MatrixXd moved(x.back().size(), used), changed(x.back().size(), used);
    for (Index j = 0; j < used; ++j) {
      const std::size_t k = x.size() - 1 - std::size_t(j);
      moved.col(j)        = x[k] - x[k - 1];
      changed.col(j)      = step[k] - step[k - 1];
    }
    const VectorXd weight    = changed.colPivHouseholderQr().solve(step.back());
    const VectorXd move      = step.back() - (moved + changed) * weight;
    constexpr double longest = 0.5;  // a factor of 1.6 in one round
    const double length      = move.cwiseAbs().maxCoeff();
    if (!std::isfinite(length))
      return plain;
    return x.back() + move * std::min(1., longest / length);
  }
};

[[noreturn]] void refuse(const std::string &where)
{
  throw SolverError({"bite.fit: the model of the run does not settle on the measured values", where,
                     "measured values that no friction and no flow stress explain with this model, or a model "
                     "whose force hardly depends on what is fitted",
                     "fit with theory = \"karman\", or fit other numbers (bite.fit_for)", ""});
}

// The model at a point, or nearer to the last point at which it had an answer; moves x there.
std::vector<Eigen::Vector3d> model_near(const PassModel &model, const FitProblem &problem, VectorXd &x,
                                        const VectorXd &last)
{
  std::string message = "the slab has no such pass";
  for (int halving = 0; halving < 6; ++halving, x = 0.5 * (x + last)) {
    if (!fit_point(problem, x, false))
      continue;
    try {
      return model(x);
    } catch (const InputError &e) {
      message = e.problems.front().message;
    } catch (const SolverError &e) {
      message = e.report.what;
    }
  }
  refuse("the model has no answer between one round and the next: " + message);
}
// With much friction the slab sticks everywhere and no longer depends on it, even if the model does.
bool slab_is_flat(const FitPoint &point)
{
  return !point.at_edge && directions_of(point).front().deviation > identified_within;
}

VectorXd residual_of(const FitProblem &problem, const std::vector<Eigen::Vector3d> &by_model)
{
  const auto data = data_of(problem);
  VectorXd residual(Index(data.size()));
  for (std::size_t i = 0; i < data.size(); ++i) {
    const MeasuredPass &pass = problem.passes[data[i].pass];
    const std::size_t kind   = std::size_t(data[i].kind);
    residual[Index(i)]       = (by_model[data[i].pass][Index(kind)] - pass.value[kind]) / pass.deviation[kind];
  }
  return residual;
}

/// Gauss and Newton's steps with slopes of the model itself: differences first, then Broyden's updates.
class ModelDescent {
public:
  ModelDescent(const FitProblem &the_problem, const PassModel &the_model, const VectorXd &start)
      : problem(the_problem), model(the_model), x(start), residual(residual_at(x)),
        slope(residual.size(), x.size())
  {
    constexpr double step = 0.02;  // a fiftieth of the value: above the noise of a mesh, below its curvature
    for (Index j = 0; j < x.size(); ++j) {
      VectorXd next = x;
      next[j] += step;
      slope.col(j) = (residual_at(next) - residual) / (next[j] - x[j]);
    }
  }

  const VectorXd &solve()
  {
    for (int round = 0; round < most_rounds; ++round) {
      VectorXd move            = slope.colPivHouseholderQr().solve(-residual);
      constexpr double longest = 0.5;  // a factor of 1.6 in one round
      move *= std::min(1., longest / std::max(1e-300, move.cwiseAbs().maxCoeff()));
      if ((slope * move).cwiseAbs().maxCoeff() < settled)
        return x;
      VectorXd next       = x + move;
      const VectorXd then = residual_at(next);
      move                = next - x;
      slope += (then - residual - slope * move) * move.transpose() / move.squaredNorm();
      if (then.squaredNorm() < residual.squaredNorm()) {
        x        = next;
        residual = then;
      }
    }
    refuse(sentence("after ", most_rounds, " rounds a measured value is still off by ",
                    residual.cwiseAbs().maxCoeff(), " standard deviations"));
  }

private:
  // Moves the point nearer to x where the model has no answer.
  VectorXd residual_at(VectorXd &point) const
  {
    return residual_of(problem, model_near(model, problem, point, x));
  }

  const FitProblem &problem;
  const PassModel &model;
  VectorXd x, residual;
  MatrixXd slope;
};

FitPoint corrected_point(FitProblem &problem, const VectorXd &x, const std::vector<Eigen::Vector3d> &by_model)
{
  correct_slab(problem, x, by_model);
  const auto point = fit_point(problem, x);
  if (!point)
    refuse("the slab has no pass at the fitted point");
  return *point;
}

// From the nearest point towards the values of the case at which the slab still depends on what is fitted.
FitPoint fit_by_slopes_of_model(FitProblem &problem, const FitPoint &flat, const PassModel &model)
{
  VectorXd x = flat.x;
  for (int halving = 0; halving < 6; ++halving) {
    x *= 0.5;
    const auto point = fit_point(problem, x);
    if (point && !slab_is_flat(*point))
      break;
  }
  x = ModelDescent(problem, model, x).solve();
  return corrected_point(problem, x, model(x));
}
}  // namespace

FitPoint fit_to_model(FitProblem &problem, const FitPoint &start, const PassModel &model)
{
  Rounds rounds;
  VectorXd x   = start.x;
  auto values  = model(x);
  double moved = 0;
  for (int round = 0; round < most_rounds; ++round) {
    if (round > 0)
      values = model_near(model, problem, x, rounds.x.back());
    const FitPoint corrected = corrected_point(problem, x, values);
    const FitPoint best      = least_misfit(problem, corrected);
    if (slab_is_flat(best))
      return fit_by_slopes_of_model(problem, best, model);
    moved = (best.residual - corrected.residual).cwiseAbs().maxCoeff();
    if (moved < settled)
      return best;
    rounds.x.push_back(x);
    rounds.step.push_back(best.x - x);
    x = rounds.extrapolated();
  }
  refuse(
      sentence("after ", most_rounds, " rounds a measured value still moves by ", moved, " standard deviations"));
}
}  // namespace mill::bite
