#include "dynamics/response/running_spectrum.h"
#include "core/base/require.h"
#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

namespace mill::dynamics {
RunningSpectrum::RunningSpectrum(const double rate, const Eigen::Index segment_length, const double mean)
    : rate_(rate), mean_(mean), power_(Eigen::ArrayXd::Zero(segment_length / 2 + 1))
{
  require(segment_length >= 2 && (segment_length & (segment_length - 1)) == 0,
          "a segment of a spectrum is a power of two");
  const auto L = double(segment_length);
  window_      = 0.5 - 0.5 * (Eigen::ArrayXd::LinSpaced(segment_length, 0, L - 1) * (2 * M_PI / L)).cos();
  samples_.reserve(std::size_t(segment_length));
}

void RunningSpectrum::add(const double sample)
{
  samples_.push_back(sample - mean_);
  const auto L = std::size_t(window_.size());
  if (samples_.size() < L)
    return;
  std::vector<double> segment(L);
  Eigen::Map<Eigen::ArrayXd>(segment.data(), Eigen::Index(L)) =
      Eigen::Map<const Eigen::ArrayXd>(samples_.data(), Eigen::Index(L)) * window_;
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> lines;
  fft.fwd(lines, segment);
  for (Eigen::Index k = 0; k < power_.size(); ++k)
    power_[k] += std::norm(lines[std::size_t(k)]);
  ++n_segments_;
  samples_.erase(samples_.begin(), samples_.begin() + std::ptrdiff_t(L / 2));  // segments overlap by half
}

Spectrum RunningSpectrum::spectrum() const
{
  const Eigen::Index lines = power_.size();
  Spectrum result{Eigen::VectorXd::LinSpaced(lines, 0, rate_ / 2), Eigen::VectorXd::Zero(lines), window_.size(),
                  n_segments_};
  if (n_segments_ == 0)
    return result;
  result.density = 2 * power_ / (rate_ * window_.square().sum() * double(n_segments_));
  result.density[0] /= 2;
  result.density[lines - 1] /= 2;
  result.density = result.density.cwiseSqrt();
  return result;
}

Eigen::Index segment_length_for(const Eigen::Index n, const Eigen::Index most)
{
  const auto power_within = [](const Eigen::Index limit) {
    Eigen::Index power = 1;
    while (2 * power <= limit)
      power *= 2;
    return power;
  };
  const Eigen::Index usual =
      std::max(power_within(std::max<Eigen::Index>(n / 8, 1)), std::min<Eigen::Index>(256, power_within(n)));
  return std::max<Eigen::Index>(2, std::min(usual, power_within(most)));
}
}  // namespace mill::dynamics
