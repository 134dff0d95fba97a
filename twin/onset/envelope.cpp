#include "twin/onset/envelope.h"
#include <cmath>

namespace mill::twin {
namespace {
constexpr double values_per_second = 50;  // 1/s

// Symmetric, odd, sums to one; Hamming's window.
std::vector<double> low_pass(const double rate, const double half_band)
{
  const auto half = int(std::lround(0.5 * filter_length_of(half_band) * rate));
  std::vector<double> taps;
  double sum = 0;
  for (int i = -half; i <= half; ++i) {
    const double x = 2 * half_band * double(i) / rate;
    taps.push_back((i == 0 ? 1 : std::sin(M_PI * x) / (M_PI * x)) *
                   (0.54 + 0.46 * std::cos(M_PI * double(i) / double(half + 1))));
    sum += taps.back();
  }
  for (double &tap : taps)
    tap /= sum;
  return taps;
}
}  // namespace

std::complex<double> EnvelopeFilter::turned_back(const std::int64_t first) const
{
  return std::polar(1.0, -2 * M_PI * std::fmod(turns * double(first + real.size() / 2), 1.0));
}

EnvelopeFilter envelope_filter(const double rate, const double frequency, const double half_band)
{
  const auto taps = low_pass(rate, half_band);
  const auto n = Eigen::Index(taps.size()), half = n / 2;
  const double w = 2 * M_PI * frequency / rate;
  EnvelopeFilter filter;
  filter.turns = frequency / rate;
  filter.step  = std::max<Eigen::Index>(1, Eigen::Index(std::lround(rate / values_per_second)));
  filter.real.resize(n);
  filter.imag.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    filter.real[i] = 2 * taps[std::size_t(i)] * std::cos(w * double(i - half));
    filter.imag[i] = -2 * taps[std::size_t(i)] * std::sin(w * double(i - half));
  }
  return filter;
}

ComplexEnvelope complex_envelope(const Eigen::VectorXd &value, const std::vector<Span> &pieces, const double rate,
                                 const double frequency, const double half_band)
{
  const EnvelopeFilter filter = envelope_filter(rate, frequency, half_band);
  const Eigen::Index n = filter.real.size(), step = filter.step;
  ComplexEnvelope result{frequency, rate / double(step), {}, {}, half_band};
  for (const Span &piece : pieces) {
    if (piece.size() < n + step)
      continue;
    const Eigen::Index m = (piece.size() - n) / step + 1;
    Eigen::VectorXcd z(m);
    for (Eigen::Index k = 0; k < m; ++k) {
      const Eigen::Index first = piece.begin + k * step;
      const auto part          = value.segment(first, n);
      z[k] = std::complex<double>(part.dot(filter.real), part.dot(filter.imag)) * filter.turned_back(first);
    }
    result.z.push_back(std::move(z));
    result.start.push_back(double(piece.begin + n / 2) / rate);
  }
  return result;
}
}  // namespace mill::twin
