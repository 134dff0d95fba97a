#pragma once
#include <cmath>
#include <complex>

// What the laws of a strip ask of a number, for double and for a complex step; for numbers that carry derivatives
// it stands in core/numerics/derivative.h.  The files of this folder need no more than the standard library and
// include each other without a folder: they travel in exported units as they are (dynamics/fmu/runtime).
namespace mill::bite {
/// Value without its derivatives.
inline double value_of(const double x)
{
  return x;
}
inline double value_of(const std::complex<double> &x)
{
  return x.real();
}

/// exp(x) - 1 without cancellation for the types the standard library leaves out; call unqualified.
inline double expm1(const double x)
{
  return std::expm1(x);
}
inline std::complex<double> expm1(const std::complex<double> &x)
{
  const double half = std::sin(0.5 * x.imag());  // real part: (e^a - 1) cos b - 2 sin^2(b/2)
  return {std::expm1(x.real()) * std::cos(x.imag()) - 2 * half * half, std::exp(x.real()) * std::sin(x.imag())};
}
inline double log1p(const double x)
{
  return std::log1p(x);
}
inline std::complex<double> log1p(const std::complex<double> &x)
{
  const double a = x.real(), b = x.imag();
  return {0.5 * std::log1p(a * (2 + a) + b * b), std::atan2(b, 1 + a)};
}
}  // namespace mill::bite
