#include "twin/detection/without_lines.h"
#include <cmath>
#include <complex>

namespace mill::twin {
namespace {
// Amplitude of a turning phasor that fits a piece best under a Hann window, so that neighbouring lines do not take
// part; the phasor is stepped, and set right every block.
void take_off(Eigen::Ref<Eigen::VectorXd> piece, const Eigen::VectorXd &window, const double cycles)
{
  constexpr Eigen::Index block    = 4096;
  const std::complex<double> step = std::polar(1.0, 2 * M_PI * cycles);
  const auto start_of             = [&](const Eigen::Index k) {
    return std::polar(1.0, 2 * M_PI * std::fmod(cycles * double(k), 1.0));
  };
  double cc = 0, cs = 0, ss = 0, xc = 0, xs = 0;
  for (Eigen::Index first = 0; first < piece.size(); first += block) {
    std::complex<double> e = start_of(first);
    for (Eigen::Index k = first; k < std::min(first + block, piece.size()); ++k, e *= step) {
      cc += window[k] * e.real() * e.real();
      cs += window[k] * e.real() * e.imag();
      ss += window[k] * e.imag() * e.imag();
      xc += window[k] * piece[k] * e.real();
      xs += window[k] * piece[k] * e.imag();
    }
  }
  const double determinant = cc * ss - cs * cs;
  if (!(determinant > 1e-9 * cc * ss))
    return;
  const double a = (xc * ss - xs * cs) / determinant, b = (xs * cc - xc * cs) / determinant;
  for (Eigen::Index first = 0; first < piece.size(); first += block) {
    std::complex<double> e = start_of(first);
    for (Eigen::Index k = first; k < std::min(first + block, piece.size()); ++k, e *= step)
      piece[k] -= a * e.real() + b * e.imag();
  }
}
}  // namespace

Eigen::VectorXd without_lines(const CleanChannel &channel, const double rate,
                              const std::vector<double> &frequencies)
{
  Eigen::VectorXd value = channel.value;
  for (const Span &piece : channel.pieces) {
    const Eigen::Index n = piece.size();
    Eigen::VectorXd window(n);
    for (Eigen::Index k = 0; k < n; ++k)
      window[k] = 0.5 - 0.5 * std::cos(2 * M_PI * (double(k) + 0.5) / double(n));
    for (const double f : frequencies)
      if (double(n) * f > 4 * rate)  // a few whole cycles at least
        take_off(value.segment(piece.begin, n), window, f / rate);
  }
  return value;
}
}  // namespace mill::twin
