#include "twin/analysis/channel_analysis.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr double lowest            = 5;    // Hz, below it a record of minutes holds drifts
constexpr double coarse            = 1.5;  // Hz, resolution at which resonances are looked for
constexpr Eigen::Index most_frames = 400;

// Largest of a spectrum and its coarser one: lines by the fine one, resonances by the coarse one.
std::vector<Peak> peaks_of(const WelchSpectrum &fine, const WelchSpectrum &rough, const double highest)
{
  std::vector<Peak> found;
  for (const Peak &peak : peaks(fine, lowest, highest))
    if (peak.line)
      found.push_back(peak);
  for (const WelchSpectrum *spectrum : {&rough, &fine})
    for (const Peak &peak : peaks(*spectrum, lowest, highest)) {
      const bool known = std::any_of(found.begin(), found.end(), [&](const Peak &other) {
        return std::abs(other.frequency - peak.frequency) <=
               std::max({peak.width, other.width, 2 * peak.resolution});
      });
      if (!known && !(peak.line && spectrum == &rough))
        found.push_back(peak);
    }
  return found;
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

Eigen::Index power_of_two_near(const double n)
{
  Eigen::Index L = 256;
  while (double(L) * 1.41 < n)
    L *= 2;
  return L;
}
}  // namespace

bool is_vibration(const Quantity quantity)
{
  return quantity != Quantity::force && quantity != Quantity::speed;
}

ChannelAnalysis analyse_channel(const CleanChannel &channel, const double rate, const Eigen::VectorXd &speed,
                                const std::vector<ChatterBand> &bands)
{
  ChannelAnalysis result{channel.name, channel.unit, channel.quantity, 0, 0, 0, 0, 0, {}, {}, {}, {}, {}};
  double square = 0, n = 0;
  for (const Span &piece : channel.pieces) {
    const auto part = channel.value.segment(piece.begin, piece.size());
    square += part.squaredNorm();
    n += double(piece.size());
    result.peak = std::max(result.peak, part.cwiseAbs().maxCoeff());
  }
  result.rms   = n > 0 ? std::sqrt(square / n) : std::numeric_limits<double>::quiet_NaN();
  result.crest = result.rms > 0 ? result.peak / result.rms : std::numeric_limits<double>::quiet_NaN();
  Fourier fourier;
  result.spectrum = welch(channel.value, channel.pieces, rate, 0, fourier);
  if (result.spectrum.n == 0)
    return result;
  result.bandwidth    = bandwidth(result.spectrum);
  result.velocity_rms = velocity_rms(result.spectrum, channel.quantity, 10, std::min(1000.0, rate / 2.56));
  for (const ChatterBand &band : bands)
    result.band_rms.push_back(rms_between(result.spectrum, band.low, band.high));
  const WelchSpectrum rough = welch(channel.value, channel.pieces, rate,
                                    std::min(result.spectrum.L, power_of_two_near(rate / coarse)), fourier);
  result.peaks              = peaks_of(result.spectrum, rough, result.bandwidth);
  const Eigen::Index L      = std::min(result.spectrum.L, frame_length(rate));
  result.map                = waterfall(channel.value, channel.pieces, rate, speed, L, most_frames, fourier);
  if (speed.size() > 0 && is_vibration(channel.quantity))
    if (const OverLength length = over_length(channel.value, channel.pieces, speed, rate); !length.pieces.empty())
      result.length = welch(length.value, length.pieces, length.rate, 0, fourier);
  return result;
}
}  // namespace mill::twin
