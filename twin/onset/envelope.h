#pragma once
#include "twin/cleaning/clean_record.h"
#include <Eigen/Core>
#include <complex>
#include <vector>

namespace mill::twin {
constexpr double envelope_filter_length = 0.1;  ///< s, of the low-pass; lags below it hold noise

/// Complex envelope of a band, 0-peak: x(t) = Re[z(t) exp(i w0 t)].  theory.md (41.12)
struct ComplexEnvelope {
  double frequency = 0;             ///< Hz, w0 / 2 pi
  double rate      = 0;             ///< 1/s, about 50
  std::vector<Eigen::VectorXcd> z;  ///< one per piece, in the unit of the channel
  std::vector<double> start;        ///< s, of the first value of each
};

/// Mixing and low-pass of a band in one: z = (taps . samples) turned back by the phase of the middle sample.
struct EnvelopeFilter {
  double turns      = 0;       ///< -, turns of w0 per sample
  Eigen::Index step = 1;       ///< samples from value to value
  Eigen::VectorXd real, imag;  ///< (n) taps, n odd
  /// exp(-i w0 t) at the middle of n samples of which the first has this number.
  std::complex<double> turned_back(std::int64_t first) const;
};
/// Low-pass of +-20 Hz (windowed sinc, 0.1 s long), 50 values per second.
EnvelopeFilter envelope_filter(double rate, double frequency);

/// Mixed with exp(-i w0 t), low-pass of +-20 Hz (windowed sinc, 0.1 s long), 50 values per second.
/// Cost O(n) times 5.
ComplexEnvelope complex_envelope(const Eigen::VectorXd &value, const std::vector<Span> &pieces, double rate,
                                 double frequency);
}  // namespace mill::twin
