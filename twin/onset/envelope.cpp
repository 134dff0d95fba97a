#include "twin/onset/envelope.h"
#include <cmath>

namespace mill::twin {
namespace {
constexpr double half_band = 20, values_per_second = 50, length = 0.3;  // Hz, 1/s, s

// Symmetric, odd, sums to one; Hamming's window.
std::vector<double> low_pass(const double rate)
{
  const auto half = int(std::lround(0.5 * length * rate));
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

ComplexEnvelope complex_envelope(const Eigen::VectorXd &value, const std::vector<Span> &pieces, const double rate,
                                 const double frequency)
{
  const auto taps = low_pass(rate);
  const auto n = Eigen::Index(taps.size()), half = n / 2;
  const double w = 2 * M_PI * frequency / rate;
  Eigen::VectorXd real(n), imag(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    real[i] = 2 * taps[std::size_t(i)] * std::cos(w * double(i - half));
    imag[i] = -2 * taps[std::size_t(i)] * std::sin(w * double(i - half));
  }
  const auto step = std::max<Eigen::Index>(1, Eigen::Index(std::lround(rate / values_per_second)));
  ComplexEnvelope result{frequency, rate / double(step), {}, {}};
  for (const Span &piece : pieces) {
    if (piece.size() < n + step)
      continue;
    const Eigen::Index m = (piece.size() - n) / step + 1;
    Eigen::VectorXcd z(m);
    for (Eigen::Index k = 0; k < m; ++k) {
      const Eigen::Index first = piece.begin + k * step;
      const auto part          = value.segment(first, n);
      const double phase       = 2 * M_PI * std::fmod(frequency / rate * double(first + half), 1.0);
      z[k]                     = std::complex<double>(part.dot(real), part.dot(imag)) * std::polar(1.0, -phase);
    }
    result.z.push_back(std::move(z));
    result.start.push_back(double(piece.begin + half) / rate);
  }
  return result;
}
}  // namespace mill::twin
