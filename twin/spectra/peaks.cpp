#include "twin/spectra/peaks.h"
#include "twin/spectra/noise_floor.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr Eigen::Index neighbours = 60;    // to each side
constexpr double least_rise       = 10;    // dB
constexpr double once_in_1e9      = 1e-9;  // -, probability

double decibel(const double ratio)
{
  return 10 * std::log10(ratio);
}

double median_around(const Eigen::VectorXd &density, const Eigen::Index k, const Eigen::Index inner,
                     const Eigen::Index outer)
{
  std::vector<double> around;
  for (Eigen::Index i = std::max<Eigen::Index>(1, k - outer); i <= std::min(k + outer, density.size() - 2); ++i)
    if (std::abs(i - k) > inner)
      around.push_back(density[i]);
  if (around.empty())
    return density[k];
  const auto middle = around.begin() + std::ptrdiff_t(around.size() / 2);
  std::nth_element(around.begin(), middle, around.end());
  return *middle;
}

// Half-power band of a resonance in bins, of the density smoothed by three bins.
Eigen::Index skirt(const Eigen::VectorXd &density, const Eigen::Index k, const double floor,
                   const Eigen::Index step)
{
  Eigen::Index i = k, low = 0;
  while (i + step > 0 && i + step < density.size() - 1 && low < 4) {
    i += step;
    low = density[i] < 2 * floor ? low + 1 : 0;
  }
  return std::abs(i - k);
}

// Few segments leave a resonance of some bins as one high bin: its neighbours stand out of the floor with it,
// those of a line do not.
bool is_of_resonance(const WelchSpectrum &s, const Eigen::Index k, const double rise)
{
  constexpr double out_of_floor = 3, out_of_flank = 13;  // dB
  const double over_flank = decibel(s.density[k] / median_around(s.density, k, 2, 6));
  return rise - over_flank > out_of_floor && over_flank < out_of_flank;
}

// Noise that a resonance leaves in one bin comes and goes: its powers scatter by their mean.  Those of a line of
// ratio r over the noise next to it scatter by sqrt(2 r - 1) / r.  (41.6a)
bool is_steady(const WelchSpectrum &s, const Eigen::Index k, const double rise)
{
  constexpr double swing       = 0.35;  // of a line itself, a third of what noise does
  constexpr Eigen::Index a_few = 4;     // segments, below which nothing can be said
  const double ratio           = std::pow(10, rise / 10);
  return s.n < a_few || s.scatter[k] < swing + std::sqrt(2 * ratio - 1) / ratio;
}

Peak peak_at(const WelchSpectrum &s, const Eigen::Index k, const double rise)
{
  const SpectralLine line = line_at(s, k);
  const bool narrow       = line.width < 1.6 * s.enbw() && !is_of_resonance(s, k, rise) && is_steady(s, k, rise);
  Peak peak{line.frequency, line.amplitude, s.density[k], rise, line.width, narrow, k, s.resolution()};
  if (!peak.line) {
    peak.frequency   = s.at(k);
    const auto half  = std::max<Eigen::Index>(1, Eigen::Index(std::lround(0.5 * line.width / s.resolution())));
    const auto first = std::max<Eigen::Index>(1, k - half), last = std::min(k + half, s.density.size() - 2);
    const double area = s.density.segment(first, last - first + 1).sum() * s.resolution();
    peak.amplitude    = std::sqrt(2 * area);
  }
  return peak;
}
}  // namespace

std::vector<Peak> peaks(const WelchSpectrum &s, const double low, const double high)
{
  std::vector<Peak> result;
  if (s.n == 0)
    return result;
  const double least = std::max(least_rise, decibel(chi_square_ratio(once_in_1e9, s.dof())));
  struct Candidate {
    Eigen::Index k;
    double median;
  };
  std::vector<Candidate> candidates;
  for (Eigen::Index k = 2; k + 2 < s.density.size(); ++k) {
    const double f = s.at(k), x = s.density[k];
    if (f < low || f > high || !(x > s.density[k - 1] && x >= s.density[k + 1]))
      continue;
    const double median = median_around(s.density, k, 0, neighbours);
    if (median > 0 && decibel(x / median) > least)
      candidates.push_back({k, median});
  }
  std::sort(candidates.begin(), candidates.end(),
            [&](const Candidate &a, const Candidate &b) { return s.density[a.k] > s.density[b.k]; });
  std::vector<Span> taken;
  for (const auto &[k, median] : candidates) {
    const Eigen::Index bin = k;
    const bool in_skirt    = std::any_of(taken.begin(), taken.end(),
                                         [&](const Span &span) { return bin >= span.begin && bin <= span.end; });
    if (in_skirt && decibel(s.density[k] / median_around(s.density, k, 2, 12)) < least)
      continue;
    if (in_skirt &&
        std::any_of(result.begin(), result.end(), [&](const Peak &p) { return std::abs(p.bin - bin) <= 4; }))
      continue;  // a side lobe of the window
    result.push_back(peak_at(s, k, decibel(s.density[k] / median)));
    taken.push_back({k - skirt(s.density, k, median, -1), k + skirt(s.density, k, median, 1)});
  }
  return result;
}
}  // namespace mill::twin
