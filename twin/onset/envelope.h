#pragma once
#include "twin/cleaning/clean_record.h"
#include <Eigen/Core>
#include <complex>
#include <vector>

namespace mill::twin {
constexpr double widest_half_band = 20;  ///< Hz, of the low-pass

/// s, length of the low-pass of a half band in Hz: two periods; lags below it hold noise that it coloured.
constexpr double filter_length_of(const double half_band)
{
  return 2 / half_band;
}
constexpr double envelope_filter_length = filter_length_of(widest_half_band);  ///< 0.1 s

/// Complex envelope of a band, 0-peak: x(t) = Re[z(t) exp(i w0 t)].  theory.md (41.12)
struct ComplexEnvelope {
  double frequency = 0;                 ///< Hz, w0 / 2 pi
  double rate      = 0;                 ///< 1/s, about 50
  std::vector<Eigen::VectorXcd> z;      ///< one per piece, in the unit of the channel
  std::vector<double> start;            ///< s, of the first value of each
  double half_band = widest_half_band;  ///< Hz, of the low-pass
};

/// Mixing and low-pass of a band in one: z = (taps . samples) turned back by the phase of the middle sample.
struct EnvelopeFilter {
  double turns      = 0;       ///< -, turns of w0 per sample
  Eigen::Index step = 1;       ///< samples from value to value
  Eigen::VectorXd real, imag;  ///< (n) taps, n odd
  /// exp(-i w0 t) at the middle of n samples of which the first has this number.
  std::complex<double> turned_back(std::int64_t first) const;
};
/// Low-pass (windowed sinc; at twice its half band nothing passes), 50 values per second.
EnvelopeFilter envelope_filter(double rate, double frequency, double half_band = widest_half_band);

/// Mixed with exp(-i w0 t), low-pass of the half band in Hz, 50 values per second.  Cost O(n) times 100/half band.
ComplexEnvelope complex_envelope(const Eigen::VectorXd &value, const std::vector<Span> &pieces, double rate,
                                 double frequency, double half_band = widest_half_band);
}  // namespace mill::twin
