#include "twin/onset/growth_stretch.h"
#include <algorithm>
#include <cmath>
#include <complex>

namespace mill::twin {
namespace {
constexpr double step_of_search = 0.25, shortest_stretch = 1, longest_stretch = 60;  // s
constexpr double least_gain = 1.2, least_slope = 0.1;                                // nepers, 1/s
constexpr double straight = 0.2, smooth = 0.07;  // of the gain, nepers: what a straight line may leave
constexpr double by_chance    = 1e-7;            // that a calm mode ends so high
constexpr double over_highest = 2, before_needed = 2, smooth_needed = 2.5;  // -, s, s

// Sums over the first k values, so that a straight line through any stretch costs no loop.
struct LogLevels {
  std::vector<double> y, ty, yy, power, highest;
  std::vector<std::complex<double>> lagged;  // z(k) z(k - lag)*
  std::size_t lag;
  LogLevels(const Eigen::VectorXcd &z, const std::size_t lag_of_filter) : lagged{0}, lag(lag_of_filter)
  {
    y = ty = yy = power = highest = {0};
    const double tiny             = 1e-6 * z.cwiseAbs().maxCoeff() + 1e-300;
    for (Eigen::Index k = 0; k < z.size(); ++k) {
      const double level = std::log(std::abs(z[k]) + tiny);
      y.push_back(y.back() + level);
      ty.push_back(ty.back() + double(k) * level);
      yy.push_back(yy.back() + level * level);
      power.push_back(power.back() + std::norm(z[k]));
      highest.push_back(std::max(highest.back(), std::norm(z[k])));
      lagged.push_back(lagged.back() + (k >= Eigen::Index(lag) ? z[k] * std::conj(z[k - Eigen::Index(lag)])
                                                               : std::complex<double>(0)));
    }
  }
};

struct StraightLine {
  double slope, left;  // per value, nepers rms
};

StraightLine line_through(const LogLevels &levels, const std::size_t first, const std::size_t end)
{
  const double n = double(end - first), middle = 0.5 * double(first + end - 1);
  const double y = levels.y[end] - levels.y[first], ty = levels.ty[end] - levels.ty[first] - middle * y;
  const double tt = n * (n * n - 1) / 12, slope = ty / tt;
  const double squares = levels.yy[end] - levels.yy[first] - y * y / n - slope * ty;
  return {slope, std::sqrt(std::max(0.0, squares / n))};
}

// Probability that a mode which noise drives ends at a mean square so many times that of the first `end` values,
// of which `fades` are independent: F distribution with 2 and 2 fades degrees of freedom.
double chance_of_level(const LogLevels &levels, const std::size_t end, const double ratio)
{
  const double share = levels.power[end] > 0 ? std::abs(levels.lagged[end]) / levels.power[end] : 1;
  const double fades = -std::log(std::clamp(share, 1e-3, 1 - 1e-9)) * double(end) / double(levels.lag);
  return std::pow(1 + ratio / fades, -fades);
}

std::optional<GrowthStretch> stretch_of_piece(const Eigen::VectorXcd &z, const double start, const double rate)
{
  const auto in_values = [&](const double seconds) { return std::size_t(std::lround(seconds * rate)); };
  const LogLevels levels(z, std::max<std::size_t>(1, in_values(envelope_filter_length)));
  const std::size_t hop = std::max<std::size_t>(1, in_values(step_of_search)), n = std::size_t(z.size());
  std::optional<GrowthStretch> best;
  for (std::size_t first = 0; first < n; first += hop)
    for (std::size_t end = first + in_values(shortest_stretch);
         end <= std::min(n, first + in_values(longest_stretch)); end += hop) {
      const StraightLine line = line_through(levels, first, end);
      const double seconds = double(end - first) / rate, gain = line.slope * double(end - first);
      if (gain < least_gain || line.slope * rate < least_slope || line.left > straight * gain ||
          (best && gain <= best->gain))
        continue;
      const std::size_t tail = std::max<std::size_t>(1, (end - first) / 8);
      const double at_end    = (levels.power[end] - levels.power[end - tail]) / double(tail);
      const double before    = first > 0 ? levels.power[first] / double(first) : 0;
      const bool beyond = double(first) / rate >= before_needed && at_end > over_highest * levels.highest[first] &&
                          before > 0 && chance_of_level(levels, first, at_end / before) < by_chance;
      const bool too_smooth = seconds >= smooth_needed && line.left < smooth && at_end > levels.highest[first];
      if (beyond || too_smooth) {
        const double independent = std::max(2.0, seconds / envelope_filter_length);
        best                     = GrowthStretch{start + double(first) / rate,
                             start + double(end - 1) / rate,
                             line.slope * rate,
                             line.left * std::sqrt(12 / independent) / seconds,
                             gain,
                             std::sqrt(at_end)};
      }
    }
  return best;
}
}  // namespace

std::optional<GrowthStretch> growth_stretch(const ComplexEnvelope &envelope)
{
  std::optional<GrowthStretch> best;
  for (std::size_t p = 0; p < envelope.z.size(); ++p)
    if (const auto stretch = stretch_of_piece(envelope.z[p], envelope.start[p], envelope.rate);
        stretch && (!best || stretch->gain > best->gain))
      best = stretch;
  return best;
}
}  // namespace mill::twin
