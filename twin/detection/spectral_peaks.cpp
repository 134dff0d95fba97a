#include "twin/detection/spectral_peaks.h"
#include "twin/detection/frames.h"
#include "twin/detection/resonances.h"
#include "twin/spectra/noise_floor.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr Eigen::Index most_tested = 400;  // maxima of one channel whose segments are looked at
constexpr double narrow            = 1.6;  // equivalent noise bandwidths
constexpr double beating           = 2.5;  // the same, widest peak of two lines

double in_decibel(const double ratio)
{
  return 10 * std::log10(ratio);
}

// Density that a line leaves so many bins away under a Hann window, over that at its own bin: envelope of the
// lobes.
double leakage(const double bins)
{
  const double d = std::max(std::abs(bins), 1.5);
  const double x = 1 / (M_PI * d * (d * d - 1));
  return x * x;
}

// What lines that are already known leave at a bin.
double leakage_at(const std::vector<SpectralCandidate> &lines, const WelchSpectrum &s, const Eigen::Index k)
{
  double sum = 0;
  for (const SpectralCandidate &line : lines)
    if (line.fate == FindingKind::line)
      sum += line.peak.density * 2 * leakage(double(k) - line.peak.frequency / s.resolution());
  return sum;
}

Peak line_peak(const WelchSpectrum &s, const Eigen::Index k, const double next_to, const double floor,
               const FrameTest &test)
{
  const SpectralLine line = line_at(s, k);
  const double noise      = std::min(0.5, next_to / s.density[k]);
  Peak peak{};
  peak.frequency  = test.n > 0 ? test.frequency : line.frequency;
  peak.amplitude  = line.amplitude * std::sqrt(1 - noise);
  peak.density    = s.density[k];
  peak.prominence = in_decibel(s.density[k] / floor);
  peak.width      = line.width;
  peak.line       = true;
  peak.bin        = k;
  peak.resolution = s.resolution();
  peak.deviation  = std::max(test.deviation, 1e-4 * s.resolution());
  peak.coherence  = test.coherence;
  peak.swing      = test.swing;
  return peak;
}

// The two lines of a peak that one line does not explain and two do: a modulated line has lines on both sides, of
// which one takes half of what is left.
std::optional<LinePair> pair_of(const Eigen::VectorXd &value, const std::vector<Span> &pieces,
                                const WelchSpectrum &s, const Peak &peak, const double ratio, const FrameTest &one)
{
  constexpr double whole = 0.97, left = 0.25;
  const bool may_be_one = peak.width < narrow * s.enbw();
  if (peak.width > beating * s.enbw() || (may_be_one && one.coherence > whole))
    return std::nullopt;
  const auto pair = line_pair(value, pieces, s, peak.bin, ratio);
  return pair && (!may_be_one || 1 - pair->coherence < left * (1 - one.coherence)) ? pair : std::nullopt;
}

// The two lines of a peak that beats, as candidates.
std::array<SpectralCandidate, 2> candidates_of(const LinePair &pair, const Peak &common, const double floor)
{
  std::array<SpectralCandidate, 2> both;
  for (std::size_t i = 0; i < 2; ++i) {
    const LinePair::Line &line = pair.lines[i];
    Peak peak                  = common;
    peak.frequency             = line.frequency;
    peak.amplitude             = line.amplitude;
    peak.density               = line.amplitude * line.amplitude / (3 * common.resolution);  // A^2/2 over 1.5 bins
    peak.prominence            = in_decibel(peak.density / floor);
    peak.deviation             = line.deviation;
    peak.coherence             = pair.coherence;
    peak.swing                 = 0;
    both[i]                    = {peak, FindingKind::line,
                                  fmt::format("{:.0f} dB over the floor, one of two lines {:.3g} Hz apart that beat ({:.0f} % of "
                                                                 "the power of their peak turns steadily)",
                                              peak.prominence, pair.lines[1].frequency - pair.lines[0].frequency,
                                              100 * pair.coherence)};
  }
  return both;
}

// Bins of a line that stand out of what is next to it.
void take_out(Eigen::VectorXd &density, const Peak &line, const double next_to)
{
  const double bin   = line.frequency / line.resolution;
  Eigen::Index reach = 2;
  while (reach < 64 && line.density * leakage(double(reach)) > 0.5 * next_to)
    ++reach;
  const auto first = std::max<Eigen::Index>(1, Eigen::Index(std::ceil(bin)) - reach),
             last  = std::min(density.size() - 2, Eigen::Index(bin) + reach);
  for (Eigen::Index i = first; i <= last; ++i)
    density[i] = std::min(density[i], next_to);
}

// What a line leaves next to it when its frequency moves a little: no more than the power that does not turn
// steadily.
bool is_skirt(const std::vector<SpectralCandidate> &candidates, const Peak &peak)
{
  constexpr double reach = 16, least_share = 1e-3;  // bins, -
  return peak.width < reach * peak.resolution &&
         std::any_of(candidates.begin(), candidates.end(), [&](const SpectralCandidate &other) {
           const double unsteady = 1 - std::min(1.0, other.peak.coherence) + least_share;
           return other.fate == FindingKind::line && peak.density < unsteady * other.peak.density &&
                  std::abs(other.peak.frequency - peak.frequency) < reach * peak.resolution;
         });
}

std::vector<Eigen::Index> maxima_above(const WelchSpectrum &s, const Eigen::VectorXd &floor,
                                       const double threshold, const double low, const double high)
{
  std::vector<Eigen::Index> tops;
  for (Eigen::Index k = 3; k + 2 < s.density.size(); ++k)
    if (const double f = s.at(k), x = s.density[k]; f >= low && f <= high && x > s.density[k - 1] &&
                                                    x >= s.density[k + 1] && floor[k] > 0 &&
                                                    x > threshold * floor[k])
      tops.push_back(k);
  std::sort(tops.begin(), tops.end(), [&](const auto a, const auto b) { return s.density[a] > s.density[b]; });
  return tops;
}
}  // namespace

SpectralPeaks spectral_peaks(const Eigen::VectorXd &value, const std::vector<Span> &pieces, const WelchSpectrum &s,
                             const double low, const double high)
{
  SpectralPeaks result;
  if (s.n == 0)
    return result;
  result.floor         = noise_floor(s);
  result.without_lines = s.density;
  const auto bins      = Eigen::Index((high - low) / s.resolution());
  result.threshold     = detection_threshold(s.dof(), bins);
  std::vector<Peak> narrow_modes;
  Eigen::Index tested = 0;
  for (const Eigen::Index k : maxima_above(s, result.floor, result.threshold, low, high)) {
    const double next_to = std::max(result.floor[k], density_next_to(s.density, k, s.dof()));
    const double leaked  = leakage_at(result.candidates, s, k);
    if (s.density[k] < result.threshold * next_to || s.density[k] < leaked + result.threshold * result.floor[k]) {
      if (s.density[k] < 4 * leaked) {
        Peak lobe = line_peak(s, k, next_to, result.floor[k], {});
        lobe.line = false;
        result.candidates.push_back({lobe, FindingKind::side_lobe, "the window spreads a stronger line that far"});
      }
      continue;
    }
    if (++tested > most_tested)
      break;
    const double ratio   = s.density[k] / std::max(next_to, leaked);
    const FrameTest test = frame_test(value, pieces, s, k, ratio);
    Peak peak            = line_peak(s, k, next_to, result.floor[k], test);
    if (const auto pair = pair_of(value, pieces, s, peak, ratio, test)) {
      for (const SpectralCandidate &one : candidates_of(*pair, peak, result.floor[k])) {
        result.candidates.push_back(one);
        take_out(result.without_lines, one.peak, next_to);
      }
    } else if (peak.width < narrow * s.enbw() && test.steady()) {
      result.candidates.push_back(
          {peak, FindingKind::line,
           fmt::format("{:.0f} dB over the floor, steady from segment to segment ({:.0f} % of its power)",
                       peak.prominence, 100 * std::min(1.0, test.coherence))});
      take_out(result.without_lines, peak, next_to);
    } else if (peak.width < narrow * s.enbw()) {
      peak.line      = false;
      peak.deviation = 0.25 * peak.width;
      narrow_modes.push_back(peak);
    }
  }
  for (const Peak &peak : resonances(s, result.without_lines, result.floor, low, high)) {
    const bool skirt = is_skirt(result.candidates, peak);
    result.candidates.push_back(
        {peak, skirt ? FindingKind::skirt : FindingKind::resonance,
         skirt ? std::string("next to a stronger line whose frequency is not quite steady")
               : fmt::format("{:.0f} dB over the floor, {:.3g} Hz wide", peak.prominence, peak.width)});
  }
  for (const Peak &peak : narrow_modes) {
    const bool skirt = is_skirt(result.candidates, peak);
    const bool known = std::any_of(result.candidates.begin(), result.candidates.end(), [&](const auto &other) {
      return other.fate == FindingKind::resonance && std::abs(other.peak.frequency - peak.frequency) <=
                                                         std::max(1.5 * other.peak.width, 3 * peak.resolution);
    });
    result.candidates.push_back(
        {peak,
         skirt   ? FindingKind::skirt
         : known ? FindingKind::part_of_resonance
                 : FindingKind::resonance,
         skirt   ? "next to a stronger line whose frequency is not quite steady"
         : known ? "its level comes and goes, and it lies within a wider peak"
                 : "narrow, but its level comes and goes from segment to segment as that of a mode"});
  }
  return result;
}
}  // namespace mill::twin
