#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>

// Forward automatic differentiation: a number that carries n derivatives.  theory.md 8.6
//
// Not Eigen's AutoDiffScalar: that one leaves out expm1 and log1p, keeps expression templates that make `auto` and
// the ternary operator unsafe, and multiplies by an infinite slope where the inner derivative is nil (a hardening
// law at zero strain), which gives nan.  Measured with nine directions: 2.6 times the time of plain numbers on the
// force integral against 1.7 of AutoDiffScalar.  Eigen's vectors inside this number are a tenth faster there and a
// third slower in long expressions of few functions, so loops it is.
namespace mill::bite {
/// A value and its derivatives by n directions.  Use like a double; comparisons look at the value alone.
///   Dual<2> x = Dual<2>::variable(3.0, 0), y = Dual<2>::variable(4.0, 1);
///   (x * y).by  ->  {4, 3}
/// Cost of an operation: that on the value plus about n multiplications.
template <int n> struct Dual {
  double value = 0;            ///< unit of the quantity
  std::array<double, n> by{};  ///< its derivatives by the n directions

  Dual() = default;
  Dual(const double constant) : value(constant) {}  // implicit on purpose: constants mix with numbers
  /// The variable of one direction; `slope` other than one scales the direction.
  static Dual variable(const double value, const int direction, const double slope = 1)
  {
    Dual x(value);
    x.by[direction] = slope;
    return x;
  }

  Dual &operator+=(const Dual &b)
  {
    value += b.value;
    for (int i = 0; i < n; ++i)
      by[i] += b.by[i];
    return *this;
  }
  Dual &operator-=(const Dual &b)
  {
    value -= b.value;
    for (int i = 0; i < n; ++i)
      by[i] -= b.by[i];
    return *this;
  }
  Dual &operator*=(const Dual &b)
  {
    for (int i = 0; i < n; ++i)
      by[i] = by[i] * b.value + value * b.by[i];
    value *= b.value;
    return *this;
  }
  Dual &operator/=(const Dual &b)
  {
    const double inverse = 1 / b.value;
    value *= inverse;
    for (int i = 0; i < n; ++i)
      by[i] = (by[i] - value * b.by[i]) * inverse;
    return *this;
  }
  Dual &operator+=(const double b)
  {
    value += b;
    return *this;
  }
  Dual &operator-=(const double b)
  {
    value -= b;
    return *this;
  }
  Dual &operator*=(const double b)
  {
    value *= b;
    for (int i = 0; i < n; ++i)
      by[i] *= b;
    return *this;
  }
  Dual &operator/=(const double b)
  {
    return *this *= 1 / b;
  }

  friend Dual operator+(Dual a, const Dual &b)
  {
    return a += b;
  }
  friend Dual operator+(Dual a, const double b)
  {
    return a += b;
  }
  friend Dual operator+(const double a, Dual b)
  {
    return b += a;
  }
  friend Dual operator-(Dual a, const Dual &b)
  {
    return a -= b;
  }
  friend Dual operator-(Dual a, const double b)
  {
    return a -= b;
  }
  friend Dual operator-(const double a, const Dual &b)
  {
    return (-b) += a;
  }
  friend Dual operator*(Dual a, const Dual &b)
  {
    return a *= b;
  }
  friend Dual operator*(Dual a, const double b)
  {
    return a *= b;
  }
  friend Dual operator*(const double a, Dual b)
  {
    return b *= a;
  }
  friend Dual operator/(Dual a, const Dual &b)
  {
    return a /= b;
  }
  friend Dual operator/(Dual a, const double b)
  {
    return a /= b;
  }
  friend Dual operator/(const double a, const Dual &b)
  {
    return Dual(a) /= b;
  }
  friend Dual operator+(const Dual &a)
  {
    return a;
  }
  friend Dual operator-(Dual a)
  {
    return a *= -1.0;
  }

  friend bool operator<(const Dual &a, const Dual &b)
  {
    return a.value < b.value;
  }
  friend bool operator>(const Dual &a, const Dual &b)
  {
    return a.value > b.value;
  }
  friend bool operator<=(const Dual &a, const Dual &b)
  {
    return a.value <= b.value;
  }
  friend bool operator>=(const Dual &a, const Dual &b)
  {
    return a.value >= b.value;
  }
  friend bool operator==(const Dual &a, const Dual &b)
  {
    return a.value == b.value;
  }
  friend bool operator!=(const Dual &a, const Dual &b)
  {
    return a.value != b.value;
  }
};

template <int n> double value_of(const Dual<n> &x)
{
  return x.value;
}

/// f(x) from its value and slope at x.  An infinite slope counts only where x depends on the direction at all.
template <int n> Dual<n> chain(const Dual<n> &x, const double value, const double slope)
{
  Dual<n> y(value);
  if (std::isfinite(slope))
    for (int i = 0; i < n; ++i)
      y.by[i] = slope * x.by[i];
  else
    for (int i = 0; i < n; ++i)
      y.by[i] = x.by[i] == 0 ? 0 : slope * x.by[i];
  return y;
}

template <int n> Dual<n> sqrt(const Dual<n> &x)
{
  const double y = std::sqrt(x.value);
  return chain(x, y, 0.5 / y);
}
template <int n> Dual<n> exp(const Dual<n> &x)
{
  const double y = std::exp(x.value);
  return chain(x, y, y);
}
template <int n> Dual<n> expm1(const Dual<n> &x)
{
  const double y = std::expm1(x.value);
  return chain(x, y, std::exp(x.value));  // not y + 1: that cancels far below zero
}
template <int n> Dual<n> log(const Dual<n> &x)
{
  return chain(x, std::log(x.value), 1 / x.value);
}
template <int n> Dual<n> log1p(const Dual<n> &x)
{
  return chain(x, std::log1p(x.value), 1 / (1 + x.value));
}
template <int n> Dual<n> sin(const Dual<n> &x)
{
  return chain(x, std::sin(x.value), std::cos(x.value));
}
template <int n> Dual<n> cos(const Dual<n> &x)
{
  return chain(x, std::cos(x.value), -std::sin(x.value));
}
template <int n> Dual<n> tan(const Dual<n> &x)
{
  const double y = std::tan(x.value);
  return chain(x, y, 1 + y * y);
}
template <int n> Dual<n> asin(const Dual<n> &x)
{
  return chain(x, std::asin(x.value), 1 / std::sqrt((1 - x.value) * (1 + x.value)));
}
template <int n> Dual<n> acos(const Dual<n> &x)
{
  return chain(x, std::acos(x.value), -1 / std::sqrt((1 - x.value) * (1 + x.value)));
}
template <int n> Dual<n> atan(const Dual<n> &x)
{
  return chain(x, std::atan(x.value), 1 / (1 + x.value * x.value));
}
template <int n> Dual<n> sinh(const Dual<n> &x)
{
  return chain(x, std::sinh(x.value), std::cosh(x.value));
}
template <int n> Dual<n> cosh(const Dual<n> &x)
{
  return chain(x, std::cosh(x.value), std::sinh(x.value));
}
template <int n> Dual<n> tanh(const Dual<n> &x)
{
  const double y = std::tanh(x.value);
  return chain(x, y, (1 - y) * (1 + y));
}
template <int n> Dual<n> asinh(const Dual<n> &x)
{
  return chain(x, std::asinh(x.value), 1 / std::hypot(1.0, x.value));
}
template <int n> Dual<n> atanh(const Dual<n> &x)
{
  return chain(x, std::atanh(x.value), 1 / ((1 - x.value) * (1 + x.value)));
}
template <int n> Dual<n> abs(const Dual<n> &x)
{
  return x.value < 0 ? -x : x;
}
template <int n> Dual<n> pow(const Dual<n> &x, const double exponent)
{
  const double y = std::pow(x.value, exponent);
  // One power instead of two, unless x = 0, where the slope is infinite, finite or nil as the exponent says.
  return chain(x, y,
               exponent == 0  ? 0
               : x.value != 0 ? exponent * y / x.value
                              : exponent * std::pow(0.0, exponent - 1));
}
template <int n> Dual<n> pow(const Dual<n> &x, const Dual<n> &exponent)
{
  Dual<n> y           = pow(x, exponent.value);
  const double by_exp = y.value == 0 ? 0 : y.value * std::log(x.value);
  for (int i = 0; i < n; ++i)
    y.by[i] += exponent.by[i] == 0 ? 0 : by_exp * exponent.by[i];
  return y;
}
template <int n> Dual<n> pow(const double x, const Dual<n> &exponent)
{
  return exp(std::log(x) * exponent);
}
template <int n> Dual<n> atan2(const Dual<n> &y, const Dual<n> &x)
{
  const double square = x.value * x.value + y.value * y.value;
  Dual<n> angle(std::atan2(y.value, x.value));
  for (int i = 0; i < n; ++i)
    angle.by[i] = (x.value * y.by[i] - y.value * x.by[i]) / square;
  return angle;
}
template <int n> Dual<n> hypot(const Dual<n> &x, const Dual<n> &y)
{
  const double r = std::hypot(x.value, y.value);
  Dual<n> length(r);
  for (int i = 0; i < n; ++i)
    length.by[i] = (x.value * x.by[i] + y.value * y.by[i]) / r;
  return length;
}
template <int n> bool isfinite(const Dual<n> &x)
{
  return std::isfinite(x.value);
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

/// Dual numbers as the scalar of small dense Eigen matrices.
namespace Eigen {
template <int n> struct NumTraits<mill::bite::Dual<n>> : NumTraits<double> {
  using Real       = mill::bite::Dual<n>;
  using NonInteger = mill::bite::Dual<n>;
  using Nested     = mill::bite::Dual<n>;
  enum {
    IsComplex             = 0,
    IsInteger             = 0,
    IsSigned              = 1,
    RequireInitialization = 1,
    ReadCost              = 1 + n,
    AddCost               = 1 + n,
    MulCost               = 1 + 2 * n
  };
};
template <int n, class Operation> struct ScalarBinaryOpTraits<mill::bite::Dual<n>, double, Operation> {
  using ReturnType = mill::bite::Dual<n>;
};
template <int n, class Operation> struct ScalarBinaryOpTraits<double, mill::bite::Dual<n>, Operation> {
  using ReturnType = mill::bite::Dual<n>;
};
}  // namespace Eigen
