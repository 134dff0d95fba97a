#include "twin/spectra/level_error.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::twin {
namespace {
constexpr Eigen::Index fewest_frames = 8;

/// Power of each frame in the band, without a factor that is common to all.
Eigen::VectorXd powers(const Waterfall &map, const double low, const double high, const bool of_velocity)
{
  const double bin = map.rate / double(map.L), middle = 0.5 * (low + high) / bin;
  const Eigen::Index most  = map.density.rows() - 1;
  const Eigen::Index first = std::clamp<Eigen::Index>(
                         std::min(Eigen::Index(std::ceil(low / bin)), Eigen::Index(middle)), 1, most),
                     last = std::clamp<Eigen::Index>(
                         std::max(Eigen::Index(std::floor(high / bin)), Eigen::Index(middle) + 1), first, most);
  Eigen::VectorXd power = Eigen::VectorXd::Zero(map.density.cols());
  for (Eigen::Index k = first; k <= last; ++k)
    power += map.density.row(k).transpose().cast<double>() / (of_velocity ? double(k * k) : 1.0);
  return power;
}
}  // namespace

double level_error(const Waterfall &map, const double low, const double high, const bool of_velocity)
{
  const Eigen::Index n = map.density.cols();
  if (n < fewest_frames || map.density.rows() < 3)
    return std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXd power = powers(map, low, high, of_velocity);
  const double mean           = power.mean();
  const Eigen::VectorXd off   = power.array() - mean;
  const double variance       = off.squaredNorm() / double(n - 1);
  if (!(mean > 0))
    return std::numeric_limits<double>::quiet_NaN();
  double spread = 1;  // (41.34): frames overlap, and levels drift
  for (Eigen::Index lag = 1; lag <= n / 4; ++lag) {
    const double correlation =
        variance > 0 ? off.head(n - lag).dot(off.tail(n - lag)) / (double(n - 1) * variance) : 0;
    if (!(correlation > 0))
      break;
    spread += 2 * correlation * (1 - double(lag) / double(n));
  }
  return 0.5 * std::sqrt(variance * spread / double(n)) / mean;
}
}  // namespace mill::twin
