#include "twin/drift/cusum.h"
#include "core/numerics/gauss.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
double normal_density(const double x)
{
  return std::exp(-0.5 * x * x) / std::sqrt(2 * M_PI);
}

double normal_below(const double x)
{
  return 0.5 * std::erfc(-x / std::sqrt(2.));
}
}  // namespace

Cusum::Cusum(const CusumRule &rule_) : rule(rule_) {}

void Cusum::restart()
{
  state = State{state.taken, state.taken, state.taken, 0, 0, 0, 0, false};
}

double Cusum::upward() const
{
  return state.up;
}

double Cusum::downward() const
{
  return state.down;
}

std::int64_t Cusum::taken() const
{
  return state.taken;
}

std::optional<Shift> Cusum::take(const double z)
{
  if (!std::isfinite(z))
    return {};
  State &s                  = state;
  const std::int64_t number = s.taken++;
  const auto one_side       = [&](const double value, double &sum, double &total, std::int64_t &since) {
    sum = std::max(0.0, sum + value - rule.slack);
    total += value;
    if (sum == 0) {
      since = number + 1;
      total = 0;
    }
  };
  one_side(z, s.up, s.sum_up, s.since_up);
  one_side(-z, s.down, s.sum_down, s.since_down);
  if (s.alarm || std::max(s.up, s.down) <= rule.threshold)
    return {};
  s.alarm          = true;
  const bool up    = s.up > s.down;
  const auto since = up ? s.since_up : s.since_down;
  return Shift{up ? 1 : -1, since, number, up ? s.up : s.down,
               (up ? s.sum_up : -s.sum_down) / double(number - since + 1)};
}

// L(u) = 1 + L(0) P(sum falls to zero) + int_0^h L(x) phi(x + k - u - shift) dx, with L(0) as one more unknown.
double cusum_run_length(const double shift, const CusumRule &rule)
{
  constexpr int n             = 64;
  const GaussRule on_unit     = gauss_legendre(n);
  const Eigen::ArrayXd point  = 0.5 * rule.threshold * (on_unit.node.array() + 1),
                       weight = 0.5 * rule.threshold * on_unit.weight.array();
  Eigen::MatrixXd A           = Eigen::MatrixXd::Identity(n + 1, n + 1);
  for (int i = 0; i <= n; ++i) {
    const double u = i < n ? point[i] : 0;
    A(i, n) -= normal_below(rule.slack - shift - u);
    for (int j = 0; j < n; ++j)
      A(i, j) -= weight[j] * normal_density(point[j] + rule.slack - u - shift);
  }
  return A.partialPivLu().solve(Eigen::VectorXd::Ones(n + 1))[n];
}

double two_sided_run_length(const double shift, const CusumRule &rule)
{
  return 1 / (1 / cusum_run_length(shift, rule) + 1 / cusum_run_length(-shift, rule));
}

double siegmund_run_length(const double shift, const CusumRule &rule)
{
  const double drift = shift - rule.slack, b = rule.threshold + 1.166;
  if (std::abs(drift) < 1e-9)
    return b * b;
  return (std::exp(-2 * drift * b) + 2 * drift * b - 1) / (2 * drift * drift);
}
}  // namespace mill::twin
