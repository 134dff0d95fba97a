#include "twin/onset/onset_watch.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr double growth_duration = 60, slope_duration = 0.2;  // s
constexpr std::size_t values_per_baseline = 5;                // ten baselines a second

std::size_t values_in(const double seconds, const double rate)
{
  return std::size_t(std::max(0L, std::lround(seconds * rate)));
}
}  // namespace

OnsetWatch::OnsetWatch(const double frequency, const double rate, const AlarmSettings &settings)
    : rule(settings), band(frequency), rate_(rate), window(values_in(settings.before, rate)),
      left_out(values_in(settings.left_out, rate)), least(values_in(settings.least, rate)),
      slope_values(std::max<std::size_t>(3, values_in(slope_duration, rate))),
      kept_values(std::max(window, values_in(growth_duration, rate)) + 1), ring(kept_values)
{
  squares.reserve(window + 1);
}

void OnsetWatch::restart()
{
  taken = in_median = out_of_median = 0;
  squares.clear();
  baseline_ = carried = 0;
  armed               = true;
  above_before        = false;
}

void OnsetWatch::carry(const double baseline)
{
  carried = baseline > 0 ? baseline : 0;
}

// 0: nothing to hold a level against yet.
double OnsetWatch::held_against() const
{
  return squares.empty() ? carried : baseline_;
}

std::complex<double> OnsetWatch::before(const std::size_t values) const
{
  return ring[(taken - 1 - values) % kept_values];
}

// (41.14) over the values k - window .. k - left_out - 1, k the last.
void OnsetWatch::renew_baseline()
{
  const std::size_t k = taken - 1, end = k - left_out, begin = k > window ? k - window : 0;
  for (; in_median < end; ++in_median) {
    const double square = std::norm(ring[in_median % kept_values]);
    squares.insert(std::upper_bound(squares.begin(), squares.end(), square), square);
  }
  for (; out_of_median < begin; ++out_of_median) {
    const double square = std::norm(ring[out_of_median % kept_values]);
    squares.erase(std::lower_bound(squares.begin(), squares.end(), square));
  }
  baseline_ = std::sqrt(squares[squares.size() / 2] / std::log(2.0));
}

// 1/s, of ln |z| over the last values.
double OnsetWatch::slope_of_log() const
{
  double tt = 0, ty = 0;
  const double middle = double(slope_values - 1) / 2;
  for (std::size_t i = 0; i < slope_values; ++i) {
    const double t = double(i) - middle;
    tt += t * t;
    ty += t * std::log(std::abs(before(slope_values - 1 - i)) + 1e-300);
  }
  return ty / tt * rate_;
}

std::optional<Alarm> OnsetWatch::take(const double time, const std::complex<double> z)
{
  if (!std::isfinite(z.real()) || !std::isfinite(z.imag())) {
    restart();
    return {};
  }
  ring[taken++ % kept_values] = z;
  const std::size_t k         = taken - 1;
  if (k >= left_out + least && (k - left_out - least) % values_per_baseline == 0)
    renew_baseline();
  const double baseline = held_against();
  if (squares.empty() && !(baseline > 0 && taken >= slope_values))
    return {};
  const double level = std::abs(z), threshold = rule.threshold * baseline;
  const bool above = level > threshold;
  std::optional<Alarm> alarm;
  if (armed && above && above_before) {
    const double sigma = slope_of_log();
    double to_limit    = std::numeric_limits<double>::quiet_NaN();
    if (rule.limit && sigma > 0)
      to_limit = std::max(0.0, std::log(*rule.limit / level) / sigma);
    alarm = Alarm{time, level, baseline, sigma, to_limit};
    armed = false;
  }
  armed        = armed || level < 0.5 * threshold;
  above_before = above;
  return alarm;
}

double OnsetWatch::level() const
{
  return taken ? std::abs(before(0)) : std::numeric_limits<double>::quiet_NaN();
}

double OnsetWatch::baseline() const
{
  return squares.empty() && !(carried > 0) ? std::numeric_limits<double>::quiet_NaN() : held_against();
}

bool OnsetWatch::above_half_threshold() const
{
  return (!squares.empty() || carried > 0) && level() >= 0.5 * rule.threshold * held_against();
}

GrowthRate OnsetWatch::growth() const
{
  const std::size_t n = std::min(taken, kept_values - 1);
  Eigen::VectorXcd z  = Eigen::VectorXcd::Zero(Eigen::Index(n));
  for (std::size_t i = 0; i < n; ++i)
    z[Eigen::Index(i)] = before(n - 1 - i);
  return growth_rate({band, rate_, {z}, {0}});
}
}  // namespace mill::twin
