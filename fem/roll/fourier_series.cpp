#include "fem/roll/fourier_series.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace mill::fem {
namespace {
// Weights of the computed orders at any order m >= 0: m G_m is smooth in ln m, a cubic through the four computed
// orders around m; constant beyond the last.
Eigen::VectorXd order_weights(const std::vector<int> &order, const double m)
{
  const int n         = int(order.size());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(n);
  int next            = int(std::lower_bound(order.begin(), order.end(), m) - order.begin());
  if (next == n) {
    out[n - 1] = order[n - 1] / m;
    return out;
  }
  if (order[next] == m) {
    out[next] = 1;
    return out;
  }
  const int first = std::min(std::max(next - 2, 1), n - 4);
  for (int i = first; i < first + 4; ++i) {
    double lagrange = 1;
    for (int j = first; j < first + 4; ++j)
      if (j != i)
        lagrange *= std::log(m / order[j]) / std::log(double(order[i]) / order[j]);
    out[i] = lagrange * order[i] / m;
  }
  return out;
}

// Sum over all harmonics as a rule: the first ones each, then one point for a run of neighbours.
struct SeriesPoint {
  double m, weight;
};
std::vector<SeriesPoint> series_rule(const double radius, const double half_width, const bool mirrored)
{
  constexpr int each     = 64;    // runs are shorter than one before this
  constexpr double share = 0.02;  // length of a run over its order: midpoint error 2e-5 of the run
  // The semi-ellipse damps as m^-3 beyond m b / R = 1; a twentieth of the half width is still resolved.
  const double last = 400 * radius / half_width;
  const int stride  = mirrored ? 2 : 1;
  std::vector<SeriesPoint> rule;
  int m = 0;
  for (; m <= each; m += stride)
    rule.push_back({double(m), double(stride)});
  while (m < last) {
    const int run = std::max(1, int(share * m / stride));
    rule.push_back({m + 0.5 * stride * (run - 1), double(stride * run)});
    m += stride * run;
  }
  return rule;
}

// Harmonic amplitude of a semi-ellipse of half width b and unit force over that of a line, and its derivative
// with respect to b: 2 J1(x) / x and -2 J2(x) / b, x = m b / R.
struct Amplitude {
  double value, slope;
};
Amplitude amplitude(const double x, const double b)
{
  if (x < 1e-4)
    return {1 - x * x / 8, -x * x / 4 / b};
  const double value = 2 * ::j1(x) / x;
  // J2 = 2 J1 / x - J0, whose two terms cancel where x is small.
  const double J2 = x < 0.1 ? x * x / 8 * (1 - x * x / 12 * (1 - x * x / 32 * (1 - x * x / 60))) : value - ::j0(x);
  return {value, -2 * J2 / b};
}
}  // namespace

StationFlexibility flexibility(const FourierSide &side, const Eigen::VectorXd &half_width)
{
  const Eigen::Index n = half_width.size(), n_orders = Eigen::Index(side.order.size());
  const auto rule     = series_rule(side.radius, side.half_width, side.mirrored);
  const auto n_points = Eigen::Index(rule.size());
  Eigen::MatrixXd shape(n_points, n), slope(n_points, n), weight(n_points, n_orders);
  for (Eigen::Index p = 0; p < n_points; ++p) {
    weight.row(p) = rule[std::size_t(p)].weight * order_weights(side.order, rule[std::size_t(p)].m);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Amplitude a = amplitude(rule[std::size_t(p)].m / side.radius * half_width[k], half_width[k]);
      shape(p, k)       = a.value;
      slope(p, k)       = a.slope;
    }
  }
  StationFlexibility out{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  for (Eigen::Index s = 0; s < n_orders; ++s) {
    // Points to which order s contributes: a short run.
    Eigen::Index from = 0, to = n_points;
    while (from < to && weight(from, s) == 0)
      ++from;
    while (to > from && weight(to - 1, s) == 0)
      --to;
    if (from == to)
      continue;
    const auto run                 = Eigen::seq(from, to - 1);
    const Eigen::MatrixXd weighted = weight(run, s).asDiagonal() * shape(run, Eigen::all);
    const auto &G                  = side.surface[std::size_t(s)];
    out.C.array() += (shape(run, Eigen::all).transpose() * weighted).array() * G.array();
    out.row_slope.array() += (slope(run, Eigen::all).transpose() * weighted).array() * G.array();
  }
  return out;
}

Eigen::VectorXd own_weights(const std::vector<int> &order, const double radius, const double half_width,
                            const PatchPressure pressure)
{
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(Eigen::Index(order.size()));
  for (const SeriesPoint &point : series_rule(radius, half_width, false)) {
    const double x = point.m * half_width / radius;
    const double j =
        pressure == PatchPressure::uniform ? (x > 0 ? std::sin(x) / x : 1) : amplitude(x, half_width).value;
    weights += point.weight * j * j * order_weights(order, point.m);
  }
  weights[1] = 0;
  return weights;
}

Eigen::VectorXd angle_weights(const std::vector<int> &order, const double angle)
{
  constexpr double width  = 0.04;  // of the radius
  constexpr int last      = 1000;  // j_m^2 / m below 1e-7
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(Eigen::Index(order.size()));
  for (int m = 0; m <= last; ++m) {
    const double j = amplitude(m * width, width).value;
    weights += j * j * std::cos(m * angle) * order_weights(order, m);
  }
  weights[1] = 0;
  return weights;
}

Eigen::MatrixXd opposite(const std::vector<int> &order, const std::vector<Eigen::MatrixXd> &surface)
{
  int each = 0;
  while (each + 1 < int(order.size()) && order[each + 1] == each + 1)
    ++each;
  const double low = 0.25 * each, high = 3. * each;
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(Eigen::Index(order.size()));
  for (int m = 0; m < high; ++m) {
    const double t = std::max(0., (m - low) / (high - low));
    weight += (m % 2 ? -1 : 1) * 0.5 * (1 + std::cos(M_PI * t)) * order_weights(order, m);
  }
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(surface[0].rows(), surface[0].cols());
  for (std::size_t s = 0; s < order.size(); ++s)
    out += weight[Eigen::Index(s)] * surface[s];
  return out;
}
}  // namespace mill::fem
