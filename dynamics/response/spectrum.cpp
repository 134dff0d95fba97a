#include "dynamics/response/spectrum.h"
#include "core/base/require.h"
#include "dynamics/response/running_spectrum.h"
#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace mill::dynamics {
namespace {
Eigen::Index power_of_two_within(const Eigen::Index n)
{
  Eigen::Index power = 1;
  while (2 * power <= n)
    power *= 2;
  return power;
}

}  // namespace

Spectrum amplitude_spectral_density(const Eigen::VectorXd &signal, const double rate, Eigen::Index segment_length)
{
  const Eigen::Index n = signal.size();
  if (segment_length == 0)
    segment_length = segment_length_for(n, n);
  const Eigen::Index L = segment_length, hop = std::max<Eigen::Index>(L / 2, 1), lines = L / 2 + 1;
  require(L >= 2 && L <= n && power_of_two_within(L) == L,
          "a segment of a spectrum is a power of two and no longer than the record");

  // periodic Hann window: its shifts by L/2 add up to one
  const Eigen::ArrayXd window =
      0.5 - 0.5 * (Eigen::ArrayXd::LinSpaced(L, 0, double(L - 1)) * (2 * M_PI / double(L))).cos();
  const double mean = signal.mean();
  Spectrum result{Eigen::VectorXd::LinSpaced(lines, 0, rate / 2), Eigen::VectorXd::Zero(lines), L, 0};
  Eigen::FFT<double> fft;
  fft.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<double> segment(std::size_t(L), 0.0);
  std::vector<std::complex<double>> lines_of_segment;
  for (Eigen::Index first = 0; first + L <= n; first += hop, ++result.n_segments) {
    Eigen::Map<Eigen::ArrayXd>(segment.data(), L) = (signal.segment(first, L).array() - mean) * window;
    fft.fwd(lines_of_segment, segment);
    for (Eigen::Index k = 0; k < lines; ++k)
      result.density[k] += std::norm(lines_of_segment[std::size_t(k)]);
  }
  const double scale = 1 / (rate * window.square().sum() * double(result.n_segments));
  result.density *= 2 * scale;  // both signs of frequency, but for 0 and rate/2, which have no partner
  result.density[0] /= 2;
  result.density[lines - 1] /= 2;
  result.density = result.density.cwiseSqrt();  // (7.11)
  return result;
}
}  // namespace mill::dynamics
