#include "twin/detection/resonances.h"
#include "twin/spectra/noise_floor.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr double least_prominence = 4;     // -, 6 dB over the floor and over the higher of the two valleys
constexpr double widest           = 0.16;  // of the frequency: the widest average
constexpr double one_octave       = 2;     // -, how far a valley is looked for
constexpr double floor_error      = 1.15;  // -, by which the floor itself may be too low
constexpr Eigen::Index scales     = 12;    // averages that are tried

// Mean over 2 half + 1 bins.
Eigen::VectorXd averaged(const Eigen::VectorXd &density, const Eigen::Index half)
{
  Eigen::VectorXd sum(density.size() + 1);
  sum[0] = 0;
  for (Eigen::Index k = 0; k < density.size(); ++k)
    sum[k + 1] = sum[k] + density[k];
  Eigen::VectorXd mean(density.size());
  for (Eigen::Index k = 0; k < density.size(); ++k) {
    const Eigen::Index first = std::max<Eigen::Index>(1, k - half),
                       end   = std::min(k + half + 1, density.size() - 1);
    mean[k]                  = end > first ? (sum[end] - sum[first]) / double(end - first) : density[k];
  }
  return mean;
}

// Degrees of freedom of such a mean: neighbouring bins under a Hann window have the correlations 4/9 and 1/36.
double averaged_dof(const double dof, const Eigen::Index half)
{
  const double m      = double(2 * half + 1);
  const double spread = 1 + 2 * (4.0 / 9 * (m - 1) / m + 1.0 / 36 * std::max(0.0, m - 2) / m);
  return dof * m / spread;
}

// Lowest value on one side before a higher maximum comes or an octave ends.
double valley(const Eigen::VectorXd &mean, const Eigen::Index k, const Eigen::Index step)
{
  double lowest = mean[k];
  for (Eigen::Index i = k + step; i >= 1 && i < mean.size() - 1; i += step) {
    if (mean[i] > mean[k] || double(i) > one_octave * double(k) || double(i) < double(k) / one_octave)
      break;
    lowest = std::min(lowest, mean[i]);
  }
  return lowest;
}

struct HalfPower {
  double low, high;  // bins
};

HalfPower half_power_band(const Eigen::VectorXd &mean, const Eigen::Index k)
{
  const double half  = mean[k] / 2;
  const auto to_side = [&](const Eigen::Index step) {
    Eigen::Index i = k;
    while (i + step > 0 && i + step < mean.size() - 1 && mean[i + step] > half)
      i += step;
    const double fall = mean[i] - mean[i + step];
    return double(i) + double(step) * (fall > 0 ? (mean[i] - half) / fall : 0.5);
  };
  return {to_side(-1), to_side(1)};
}

Peak resonance_at(const WelchSpectrum &s, const Eigen::VectorXd &density, const Eigen::VectorXd &mean,
                  const double floor, const Eigen::Index k, const Eigen::Index half)
{
  const HalfPower band = half_power_band(mean, k);
  const double df = s.resolution(), wide = (band.high - band.low) * df;
  // an average of 2 half + 1 bins under a Hann window of 1.44 bins widens it
  const double added = std::hypot(1.44, double(2 * half)) * df;
  Peak peak{};
  peak.frequency  = 0.5 * (band.low + band.high) * df;
  peak.density    = mean[k];
  peak.prominence = 10 * std::log10(mean[k] / floor);
  peak.width      = std::sqrt(std::max(wide * wide - added * added, df * df));
  peak.line       = false;
  peak.bin        = k;
  peak.resolution = df;
  double area     = 0;
  for (auto i = std::max<Eigen::Index>(1, Eigen::Index(std::ceil(band.low))); i <= Eigen::Index(band.high); ++i)
    area += density[i] * df;
  peak.amplitude = std::sqrt(2 * area);
  peak.deviation = 0.25 * std::max(peak.width, df);
  return peak;
}

bool overlaps(const Peak &one, const Peak &other)
{
  return std::abs(one.frequency - other.frequency) <=
         std::max({1.5 * one.width, 1.5 * other.width, 3 * one.resolution});
}
}  // namespace

std::vector<Peak> resonances(const WelchSpectrum &s, const Eigen::VectorXd &density, const Eigen::VectorXd &floor,
                             const double low, const double high)
{
  struct Scored {
    Peak peak;
    double score;
  };
  std::vector<Scored> all;
  const auto first = std::max<Eigen::Index>(3, Eigen::Index(std::ceil(low / s.resolution()))),
             last  = std::min(Eigen::Index(high / s.resolution()), s.density.size() - 3);
  for (Eigen::Index half = 0; double(2 * half + 1) * s.resolution() < widest * high;
       half              = half == 0 ? 1 : 2 * half) {
    const Eigen::VectorXd mean = averaged(density, half);
    const double dof           = averaged_dof(s.dof(), half);
    const auto bins            = std::max<Eigen::Index>(1, (last - first) / (2 * half + 1));
    const double up            = floor_error * detection_threshold(dof, scales * bins),
                 down          = chi_square_ratio(1 - 1.0 / double(bins + 1), dof);
    const double rise          = std::max(least_prominence, up / std::max(down, 1e-3));
    const auto least_k         = std::max(first, Eigen::Index(double(2 * half + 1) / widest));
    for (Eigen::Index k = least_k; k <= last; ++k)
      if (mean[k] > mean[k - 1] && mean[k] >= mean[k + 1] && mean[k] > std::max(up, least_prominence) * floor[k] &&
          mean[k] >= rise * std::max(valley(mean, k, -1), valley(mean, k, 1)))
        all.push_back({resonance_at(s, density, mean, std::max(floor[k], 1e-300), k, half),
                       std::log(mean[k] / std::max(floor[k], 1e-300)) * std::sqrt(dof)});
  }
  // the average that fits the width best is the most certain one
  std::sort(all.begin(), all.end(), [](const Scored &a, const Scored &b) { return a.score > b.score; });
  std::vector<Peak> peaks;
  for (const Scored &one : all)
    if (std::none_of(peaks.begin(), peaks.end(), [&](const Peak &other) { return overlaps(one.peak, other); }))
      peaks.push_back(one.peak);
  std::sort(peaks.begin(), peaks.end(), [](const Peak &a, const Peak &b) { return a.density > b.density; });
  return peaks;
}
}  // namespace mill::twin
