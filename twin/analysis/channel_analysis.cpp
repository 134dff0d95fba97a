#include "twin/analysis/channel_analysis.h"
#include "twin/detection/spectral_peaks.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr double lowest            = 5;     // Hz, below it a record of minutes holds drifts
constexpr double fewest_periods    = 4;     // bins from the mean to the lowest peak
constexpr double highest_part      = 0.49;  // of the rate
constexpr Eigen::Index most_frames = 400;
constexpr double least_of_offset   = 1e-9;  // -, rms over the offset that was taken off

double lowest_peak(const WelchSpectrum &s)
{
  return std::max(lowest, fewest_periods * s.resolution());
}

// Root of the area under the density; NaN where the record ends below.
double rms_between(const WelchSpectrum &s, const double low, const double high)
{
  if (high > s.rate / 2.56)
    return std::numeric_limits<double>::quiet_NaN();
  double area = 0;
  for (Eigen::Index k = 1; k < s.density.size(); ++k)
    if (s.at(k) >= low && s.at(k) <= high)
      area += s.density[k] * s.resolution();
  return std::sqrt(area);
}

constexpr double velocity_low = 10, velocity_high = 1000;  // Hz
constexpr double same_band = 0.01;  // -, of the upper end: rates of one recorder differ by their jitter
}  // namespace

VelocityBand velocity_band(const double rate)
{
  const double end = rate / 2.56;
  return {velocity_low, std::min(velocity_high, end), end >= velocity_high};
}

bool have_one_band(const double rate_a, const double rate_b)
{
  if (!std::isfinite(rate_a) || !std::isfinite(rate_b))
    return false;
  const double a = velocity_band(rate_a).high, b = velocity_band(rate_b).high;
  return std::abs(a - b) <= same_band * std::max(a, b);
}

double velocity_before(const Baseline &baseline, const std::string &channel, const double rate)
{
  const auto before = baseline.velocity_rms.find(channel);
  if (before == baseline.velocity_rms.end() || !(before->second.value > 0) ||
      !have_one_band(before->second.rate, rate))
    return std::numeric_limits<double>::quiet_NaN();
  return before->second.value;
}

bool is_vibration(const Quantity quantity)
{
  return quantity != Quantity::force && quantity != Quantity::speed;
}

ChannelAnalysis analyse_channel(const CleanChannel &channel, const double rate, const Eigen::VectorXd &speed,
                                const std::vector<ChatterBand> &bands)
{
  ChannelAnalysis result{
      channel.name, channel.unit, channel.quantity, 0, 0, 0, 0, 0, 0, 0, {}, {}, {}, {}, {}, {}};
  double square = 0, sum = 0, n = 0;
  for (const Span &piece : channel.pieces) {
    const auto part = channel.value.segment(piece.begin, piece.size());
    square += part.squaredNorm();
    sum += part.sum();
    n += double(piece.size());
    result.peak = std::max(result.peak, part.cwiseAbs().maxCoeff());
  }
  result.rms      = n > 0 ? std::sqrt(square / n) : std::numeric_limits<double>::quiet_NaN();
  result.crest    = result.rms > 0 ? result.peak / result.rms : std::numeric_limits<double>::quiet_NaN();
  result.variance = n > 0 ? std::max(0.0, square / n - (sum / n) * (sum / n)) : 0;
  if (!(result.rms > least_of_offset * std::abs(channel.offset)))
    return result;  // a constant or an exact ramp: what is left of it is rounding
  Fourier fourier;
  result.spectrum = welch(channel.value, channel.pieces, rate, 0, fourier);
  if (result.spectrum.n == 0)
    return result;
  result.bandwidth    = bandwidth(result.spectrum);
  const auto band     = velocity_band(rate);
  result.velocity_rms = velocity_rms(result.spectrum, channel.quantity, band.low, band.high);
  for (const ChatterBand &band : bands)
    result.band_rms.push_back(rms_between(result.spectrum, band.low, band.high));
  result.lowest = lowest_peak(result.spectrum);
  result.detected =
      spectral_peaks(channel.value, channel.pieces, result.spectrum, result.lowest, highest_part * rate);
  const Eigen::Index L = std::min(result.spectrum.L, frame_length(rate));
  result.map           = waterfall(channel.value, channel.pieces, rate, speed, L, most_frames, fourier);
  if (speed.size() > 0 && is_vibration(channel.quantity))
    if (const OverLength length = over_length(channel.value, channel.pieces, speed, rate); !length.pieces.empty())
      result.length = welch(length.value, length.pieces, length.rate, 0, fourier);
  return result;
}
}  // namespace mill::twin
