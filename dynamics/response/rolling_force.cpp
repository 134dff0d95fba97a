#include "dynamics/response/rolling_force.h"
#include "core/base/errors.h"
#include "dynamics/response/spectrum.h"
#include <cmath>
#include <complex>
#include <cstdio>
#include <random>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace mill::dynamics {
namespace {
std::string hertz(const double frequency)
{
  char text[40];
  std::snprintf(text, sizeof text, "%.4g Hz", frequency);
  return text;
}

// The record on even times at its mean rate; an even record comes back as it is.
Eigen::VectorXd evenly_read(const ForceRecord &record)
{
  const Eigen::Index n = record.time.size();
  const double spacing = (record.time[n - 1] - record.time[0]) / double(n - 1);
  Eigen::VectorXd even(n);
  Eigen::Index i = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double t = record.time[0] + double(k) * spacing;
    while (i + 2 < n && record.time[i + 1] <= t)
      ++i;
    const double part = (t - record.time[i]) / (record.time[i + 1] - record.time[i]);
    even[k]           = record.force[i] + part * (record.force[i + 1] - record.force[i]);
  }
  return even;
}

// Highest frequency within 3 dB of the power-weighted mean density  S_mean = sum S^2 / sum S.  (7.12)
double upper_edge(const Spectrum &spectrum)
{
  const Eigen::ArrayXd power = spectrum.density.array().square();
  if (!(power.sum() > 0))
    return 0;
  const double level = power.square().sum() / power.sum();
  Eigen::Index last  = power.size() - 1;
  while (power[last] < level / 2)
    --last;
  return spectrum.frequency[last];
}

void require_synthetic(const bool condition, const std::string &message)
{
  if (!condition)
    throw InputError("synthetic rolling force: " + message);
}

// Box and Muller's pair of normal deviates from two uniform ones in (0, 1].
std::complex<double> normal_pair(std::mt19937_64 &engine)
{
  const auto uniform  = [&] { return double((engine() >> 11) + 1) * 0x1p-53; };
  const double radius = std::sqrt(-2 * std::log(uniform()));
  return std::polar(radius, 2 * M_PI * uniform());
}
}  // namespace

ForceStatistics force_statistics(const ForceRecord &record)
{
  const Eigen::Index n = record.time.size();
  ForceStatistics s;
  s.mean        = record.force.mean();
  s.smallest    = record.force.minCoeff();
  s.largest     = record.force.maxCoeff();
  s.rms         = std::sqrt((record.force.array() - s.mean).square().mean());
  s.duration    = record.time[n - 1] - record.time[0];
  s.sample_rate = double(n - 1) / s.duration;
  s.bandwidth   = s.sample_rate / 2;
  s.content     = upper_edge(amplitude_spectral_density(evenly_read(record), s.sample_rate));
  return s;
}

std::optional<Warning> bandwidth_warning(const ForceStatistics &statistics, const double highest_mode)
{
  if (statistics.bandwidth < highest_mode)
    return Warning{WarningId::force_band, "",
                   "the rolling force is sampled at " + hertz(statistics.sample_rate) +
                       " and contains nothing above " + hertz(statistics.bandwidth) +
                       ", but the highest mode is at " + hertz(highest_mode),
                   "the accelerations of that mode are missing, not small"};
  if (statistics.content < highest_mode)
    return Warning{WarningId::force_band, "",
                   "the content of the rolling force ends near " + hertz(statistics.content) +
                       ", below the highest mode at " + hertz(highest_mode),
                   "a sensor or filter of that bandwidth hides the excitation of the mode"};
  return {};
}

ForceRecord synthetic_force(const NoiseSettings &settings)
{
  require_synthetic(settings.range[1] > settings.range[0],
                    "the range needs a smaller and a larger value, in this order");
  require_synthetic(settings.bandwidth > 0 && settings.bandwidth <= settings.rate / 2,
                    "bandwidth " + hertz(settings.bandwidth) + " is outside 0 .. " + hertz(settings.rate / 2) +
                        ", half the sample rate");
  const auto n = Eigen::Index(std::llround(settings.duration * settings.rate)) + 1;
  require_synthetic(n >= 2, "the duration is shorter than one sample spacing");

  // A power of two longer than the record: the transform is cheap and the record does not close into a circle.
  Eigen::Index length = 2;
  while (length < n + 1)
    length *= 2;
  std::mt19937_64 engine(settings.seed);
  std::vector<std::complex<double>> lines(std::size_t(length / 2 + 1), 0.0);
  for (Eigen::Index k = 1; k < length / 2 && double(k) * settings.rate / double(length) <= settings.bandwidth; ++k)
    lines[std::size_t(k)] = normal_pair(engine);  // (7.13)
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<double> noise;
  fft.inv(noise, lines, length);

  ForceRecord record;
  record.time                 = Eigen::ArrayXd::LinSpaced(n, 0, double(n - 1)) / settings.rate;
  const Eigen::VectorXd white = Eigen::Map<const Eigen::VectorXd>(noise.data(), n);
  Eigen::Index low = 0, high = 0;
  const double smallest = white.minCoeff(&low), largest = white.maxCoeff(&high);
  require_synthetic(largest > smallest,
                    "bandwidth " + hertz(settings.bandwidth) + " leaves no line of the spectrum to fill");
  const double scale = (settings.range[1] - settings.range[0]) / (largest - smallest);
  record.force       = settings.range[0] + (white.array() - smallest) * scale;
  record.force[low]  = settings.range[0];  // exact, whatever the rounding of the line above
  record.force[high] = settings.range[1];
  record.notes       = {"made, not measured: Gaussian noise white to " + hertz(settings.bandwidth) + ", seed " +
                        std::to_string(settings.seed)};
  return record;
}
}  // namespace mill::dynamics
