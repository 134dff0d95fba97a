#include "twin/spectra/noise_floor.h"
#include "core/numerics/quantiles.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace mill::twin {
namespace {
constexpr double low_quantile = 0.2, next_quantile = 0.3;  // -, of the bins
constexpr Eigen::Index fewest_bins = 50, most_sampled = 4000;
constexpr Eigen::Index next_first = 3, next_last = 15;  // bins to each side

double quantile_of(std::vector<double> &values, const double part)
{
  const auto place = values.begin() + std::ptrdiff_t(part * double(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}
}  // namespace

double chi_square_ratio(const double probability, const double dof)
{
  return chi_square_above(probability, dof) / dof;
}

double detection_threshold(const double dof, const Eigen::Index bins)
{
  return chi_square_ratio(false_alarm / double(std::max<Eigen::Index>(1, bins)), dof);
}

Eigen::VectorXd noise_floor(const WelchSpectrum &s)
{
  const Eigen::Index last = s.density.size() - 2;  // the bins of the mean and of half the rate are left out
  Eigen::VectorXd floor   = Eigen::VectorXd::Zero(s.density.size());
  if (s.n == 0 || last < 1)
    return floor;
  const double bias = chi_square_ratio(1 - low_quantile, s.dof()), sixth = std::pow(2.0, 1.0 / 6);
  Eigen::Index before = -1;
  double level_before = 0;
  std::vector<double> part;
  for (Eigen::Index k = 1; k <= last;
       k              = k == last ? last + 1 : std::min(last, k + std::max<Eigen::Index>(4, k / 32))) {
    Eigen::Index first = Eigen::Index(double(k) / sixth), end = Eigen::Index(std::ceil(double(k) * sixth)) + 1;
    first = std::clamp<Eigen::Index>(std::min(first, k - fewest_bins / 2), 1,
                                     std::max<Eigen::Index>(1, last - fewest_bins));
    end   = std::min(std::max(end, first + fewest_bins), last + 1);
    part.clear();
    const Eigen::Index stride = std::max<Eigen::Index>(1, (end - first) / most_sampled);
    for (Eigen::Index i = first; i < end; i += stride)
      part.push_back(s.density[i]);
    const double level = quantile_of(part, low_quantile) / bias;
    for (Eigen::Index i = before + 1; i <= k; ++i) {  // straight lines in the logarithm between the knots
      const double t = before < 0 ? 1 : double(i - before) / double(k - before);
      floor[i]       = before < 0 || !(level_before > 0 && level > 0) ? level
                                                                      : level_before * std::pow(level / level_before, t);
    }
    before       = k;
    level_before = level;
  }
  floor[last + 1] = level_before;
  return floor;
}

double density_next_to(const Eigen::VectorXd &density, const Eigen::Index k, const double dof)
{
  double largest = 0;
  std::vector<double> part;
  for (const int sign : {-1, 1}) {
    part.clear();
    for (Eigen::Index i = next_first; i <= next_last; ++i)
      if (const Eigen::Index j = k + sign * i; j >= 1 && j < density.size() - 1)
        part.push_back(density[j]);
    if (part.size() > 4)
      largest = std::max(largest, quantile_of(part, next_quantile));
  }
  return largest / chi_square_ratio(1 - next_quantile, dof);
}
}  // namespace mill::twin
