#include "core/numerics/quantiles.h"
#include "reduce/bite/fit/fit.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

// Intervals and regions from the misfit itself, not from its curvature.  theory.md (31.6)
namespace mill::bite {
namespace {
using Eigen::Index;
using Eigen::VectorXd;

// Chi-square of one and of two degrees of freedom at 95 %.
constexpr double one_number = 3.841458820694124, two_numbers = 5.991464547107979;

/// Rise of the misfit above its least value at a distance; nothing where no pass exists.
using Rise = std::function<std::optional<double>(double distance)>;

struct Reach {
  double distance = 0;
  bool open       = false;  ///< no pass exists beyond
};

/// Distance at which the rise reaches a limit, from a guess of it.  Outward in steps to a bracket, then by halves
/// and secants of the root of the rise, which is nearly straight.
Reach reach_of(const Rise &rise, const double limit, const double guess)
{
  double inside = 0, at_inside = 0, outside = guess, at_outside = -1;  // root of the rise; -1: does not exist
  const double wanted = std::sqrt(limit);
  constexpr int most  = 60;
  for (int i = 0; i < most; ++i) {  // until something lies outside
    const auto there = rise(outside);
    at_outside       = there ? std::sqrt(std::max(0., *there)) : -1;
    if (!there || at_outside >= wanted)
      break;
    inside    = outside;
    at_inside = at_outside;
    outside *= 1.5;
  }
  if (at_outside >= 0 && at_outside < wanted)
    return {outside, true};
  for (int i = 0; i < most && outside - inside > 2e-4 * outside; ++i) {
    const bool exists = at_outside >= 0;
    double middle     = exists ? inside + (outside - inside) * (wanted - at_inside) / (at_outside - at_inside)
                               : 0.5 * (inside + outside);
    if (exists && i % 3 == 2)
      middle = 0.5 * (inside + outside);
    const auto there      = rise(middle);
    const double at_there = there ? std::sqrt(std::max(0., *there)) : -1;
    if (there && std::abs(at_there - wanted) < 1e-4 * wanted)
      return {middle, false};
    (there && at_there < wanted ? inside : outside)       = middle;
    (there && at_there < wanted ? at_inside : at_outside) = at_there;
  }
  return at_outside < 0 ? Reach{inside, true} : Reach{0.5 * (inside + outside), false};
}

/// Misfit with some unknowns at given values and the others at their best; nothing where no pass exists.
class HeldMisfit {
public:
  HeldMisfit(const FitProblem &the_problem, const FitPoint &from, std::vector<bool> which)
      : problem(the_problem), last(from), held(std::move(which))
  {
    for (const bool h : held)
      all_held = all_held && h;
  }
  std::optional<double> at(const VectorXd &values)
  {
    VectorXd x = last.x;
    for (Index j = 0; j < x.size(); ++j)
      if (held[std::size_t(j)])
        x[j] = values[j];
    auto start = fit_point(problem, x, !all_held);
    if (!start)
      return std::nullopt;
    if (all_held)
      return start->misfit;
    last = least_misfit(problem, *start, held);
    return last.misfit;
  }

private:
  const FitProblem &problem;
  FitPoint last;
  std::vector<bool> held;
  bool all_held = true;
};

double deviation_of(const FitPoint &best, const Index i)
{
  const double variance = covariance_of(best)(i, i);
  return std::isfinite(variance) && variance > 0 ? std::min(std::sqrt(variance), 1.) : 0.5;
}
}  // namespace

FitInterval profile_interval(const FitProblem &problem, const FitPoint &best, const std::size_t i)
{
  std::vector<bool> held(problem.unknowns.size(), false);
  held[i]            = true;
  const double guess = std::sqrt(one_number) * deviation_of(best, Index(i));
  const auto along   = [&](const double sign) {
    HeldMisfit misfit(problem, best, held);
    return reach_of(
        [&](const double distance) -> std::optional<double> {
          VectorXd x = best.x;
          x[Index(i)] += sign * distance;
          const auto there = misfit.at(x);
          return there ? std::optional(*there - best.misfit) : std::nullopt;
        },
        one_number, guess);
  };
  const Reach down = along(-1), up = along(1);
  const double best_value = best.x[Index(i)];
  return {best_value - down.distance, best_value + up.distance, down.open, up.open};
}

Eigen::MatrixXd confidence_region(const FitProblem &problem, const FitPoint &best, const std::size_t i,
                                  const std::size_t j, const int n)
{
  const Eigen::MatrixXd all = covariance_of(best);
  Eigen::Matrix2d part;
  part << all(Index(i), Index(i)), all(Index(i), Index(j)), all(Index(j), Index(i)), all(Index(j), Index(j));
  const Eigen::Matrix2d root = part.llt().matrixL();
  std::vector<bool> held(problem.unknowns.size(), false);
  held[i] = held[j] = true;
  Eigen::MatrixXd edge(n, 2);
  for (int k = 0; k < n; ++k) {
    const double angle       = 2 * M_PI * k / (n - 1);
    const Eigen::Vector2d to = root * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    HeldMisfit misfit(problem, best, held);
    const auto value_at = [&](const double distance) {
      VectorXd x = best.x;
      x[Index(i)] += distance * to[0];
      x[Index(j)] += distance * to[1];
      return x;
    };
    const Reach reach = reach_of(
        [&](const double distance) -> std::optional<double> {
          const auto there = misfit.at(value_at(distance));
          return there ? std::optional(*there - best.misfit) : std::nullopt;
        },
        two_numbers, std::sqrt(two_numbers));
    const VectorXd x = value_at(reach.distance);
    edge.row(k) << x[Index(i)], x[Index(j)];
  }
  return edge;
}

double largest_likely_misfit(const int freedom)
{
  return chi_square_above(0.01, freedom);
}
}  // namespace mill::bite
