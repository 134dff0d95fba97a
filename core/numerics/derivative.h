#pragma once
#include "core/laws/plain_number.h"
#include <Eigen/Core>
#include <array>
#include <cmath>
#include <complex>
#include <type_traits>

// Forward automatic differentiation: a number that carries n derivatives.  theory.md 8.6
//
// Not Eigen's AutoDiffScalar: that one leaves out expm1 and log1p, keeps expression templates that make `auto` and
// the ternary operator unsafe, and multiplies by an infinite slope where the inner derivative is zero (a hardening
// law at zero strain), which gives nan.  Measured with nine directions: 2.6 times the time of plain numbers on the
// force integral against 1.7 of AutoDiffScalar.  Eigen's vectors inside this number are a tenth faster there and a
// third slower in long expressions of few functions, so loops it is.
namespace mill::bite {
/// A value and its derivatives by n directions.  Use like a double; comparisons look at the value alone.
///   Dual<2> x = Dual<2>::variable(3.0, 0), y = Dual<2>::variable(4.0, 1);
///   (x * y).by  ->  {4, 3}
/// S is the number beneath: double, or a Dual itself, whose directions then are differentiated once more:
/// Dual<2, Dual<3>> carries the 2 x 3 mixed second derivatives.
/// Cost of an operation: that on the value plus about n multiplications.
template <int n, class S = double> struct Dual {
  S value = 0;            ///< unit of the quantity
  std::array<S, n> by{};  ///< its derivatives by the n directions

  Dual() = default;
  Dual(const double constant) : value(constant) {}  // implicit on purpose: constants mix with numbers
  /// A number that moves with the directions of S alone.
  template <class Number, class = std::enable_if_t<std::is_same_v<Number, S> && !std::is_same_v<S, double>>>
  Dual(const Number &constant) : value(constant)
  {
  }
  /// The variable of one direction; `slope` other than one scales the direction.
  static Dual variable(const S &value, const int direction, const double slope = 1)
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
    const S inverse = 1.0 / b.value;
    if constexpr (std::is_same_v<S, double>)
      value *= inverse;
    else
      value /= b.value;  // x/x = 1 with derivatives that are zero and not rounding
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

template <int n, class S> double value_of(const Dual<n, S> &x)
{
  return value_of(x.value);
}

/// f(x) from its value and slope at x.  An infinite slope enters only where x depends on the direction.
template <int n, class S> Dual<n, S> chain(const Dual<n, S> &x, const S &value, const S &slope)
{
  Dual<n, S> y(value);
  if (std::isfinite(value_of(slope)))
    for (int i = 0; i < n; ++i)
      y.by[i] = slope * x.by[i];
  else
    for (int i = 0; i < n; ++i)
      y.by[i] = x.by[i] == 0 ? S(0) : slope * x.by[i];
  return y;
}

template <int n, class S> Dual<n, S> sqrt(const Dual<n, S> &x)
{
  using std::sqrt;
  const S y = sqrt(x.value);
  return chain(x, y, S(0.5 / y));
}
template <int n, class S> Dual<n, S> exp(const Dual<n, S> &x)
{
  using std::exp;
  const S y = exp(x.value);
  return chain(x, y, y);
}
template <int n, class S> Dual<n, S> expm1(const Dual<n, S> &x)
{
  using std::exp;
  using std::expm1;
  const S y = expm1(x.value);
  return chain(x, y, S(exp(x.value)));  // not y + 1: that cancels far below zero
}
template <int n, class S> Dual<n, S> log(const Dual<n, S> &x)
{
  using std::log;
  return chain(x, S(log(x.value)), S(1.0 / x.value));
}
template <int n, class S> Dual<n, S> log1p(const Dual<n, S> &x)
{
  using std::log1p;
  return chain(x, S(log1p(x.value)), S(1.0 / (1.0 + x.value)));
}
template <int n, class S> Dual<n, S> sin(const Dual<n, S> &x)
{
  using std::cos;
  using std::sin;
  return chain(x, S(sin(x.value)), S(cos(x.value)));
}
template <int n, class S> Dual<n, S> cos(const Dual<n, S> &x)
{
  using std::cos;
  using std::sin;
  return chain(x, S(cos(x.value)), S(-sin(x.value)));
}
template <int n, class S> Dual<n, S> tan(const Dual<n, S> &x)
{
  using std::tan;
  const S y = tan(x.value);
  return chain(x, y, S(1.0 + y * y));
}
template <int n, class S> Dual<n, S> asin(const Dual<n, S> &x)
{
  using std::asin;
  using std::sqrt;
  return chain(x, S(asin(x.value)), S(1.0 / sqrt((1.0 - x.value) * (1.0 + x.value))));
}
template <int n, class S> Dual<n, S> acos(const Dual<n, S> &x)
{
  using std::acos;
  using std::sqrt;
  return chain(x, S(acos(x.value)), S(-1.0 / sqrt((1.0 - x.value) * (1.0 + x.value))));
}
template <int n, class S> Dual<n, S> atan(const Dual<n, S> &x)
{
  using std::atan;
  return chain(x, S(atan(x.value)), S(1.0 / (1.0 + x.value * x.value)));
}
template <int n, class S> Dual<n, S> sinh(const Dual<n, S> &x)
{
  using std::cosh;
  using std::sinh;
  return chain(x, S(sinh(x.value)), S(cosh(x.value)));
}
template <int n, class S> Dual<n, S> cosh(const Dual<n, S> &x)
{
  using std::cosh;
  using std::sinh;
  return chain(x, S(cosh(x.value)), S(sinh(x.value)));
}
template <int n, class S> Dual<n, S> tanh(const Dual<n, S> &x)
{
  using std::tanh;
  const S y = tanh(x.value);
  return chain(x, y, S((1.0 - y) * (1.0 + y)));
}
template <int n, class S> Dual<n, S> asinh(const Dual<n, S> &x)
{
  using std::asinh;
  using std::hypot;
  return chain(x, S(asinh(x.value)), S(1.0 / hypot(S(1.0), x.value)));
}
template <int n, class S> Dual<n, S> atanh(const Dual<n, S> &x)
{
  using std::atanh;
  return chain(x, S(atanh(x.value)), S(1.0 / ((1.0 - x.value) * (1.0 + x.value))));
}
template <int n, class S> Dual<n, S> abs(const Dual<n, S> &x)
{
  return x.value < 0 ? -x : x;
}
template <int n, class S> Dual<n, S> pow(const Dual<n, S> &x, const double exponent)
{
  using std::pow;
  const S y = pow(x.value, exponent);
  // One power instead of two, unless x = 0, where the slope is infinite, finite or zero as the exponent says.
  return chain(x, y,
               exponent == 0  ? S(0)
               : x.value != 0 ? S(exponent * y / x.value)
                              : S(exponent * std::pow(0.0, exponent - 1)));
}
template <int n, class S> Dual<n, S> pow(const Dual<n, S> &x, const Dual<n, S> &exponent)
{
  using std::log;
  using std::pow;
  const S &e     = exponent.value;
  const S y      = pow(x.value, e);
  Dual<n, S> z   = chain(x, y, e == 0 ? S(0) : x.value != 0 ? S(e * y / x.value) : S(e * pow(S(0.0), S(e - 1.0))));
  const S by_exp = y == 0 ? S(0) : S(y * log(x.value));
  for (int i = 0; i < n; ++i)
    z.by[i] += exponent.by[i] == 0 ? S(0) : S(by_exp * exponent.by[i]);
  return z;
}
template <int n, class S> Dual<n, S> pow(const double x, const Dual<n, S> &exponent)
{
  return exp(std::log(x) * exponent);
}
template <int n, class S> Dual<n, S> atan2(const Dual<n, S> &y, const Dual<n, S> &x)
{
  using std::atan2;
  const S square = x.value * x.value + y.value * y.value;
  Dual<n, S> angle(S(atan2(y.value, x.value)));
  for (int i = 0; i < n; ++i)
    angle.by[i] = (x.value * y.by[i] - y.value * x.by[i]) / square;
  return angle;
}
template <int n, class S> Dual<n, S> hypot(const Dual<n, S> &x, const Dual<n, S> &y)
{
  using std::hypot;
  const S r = hypot(x.value, y.value);
  Dual<n, S> length(r);
  for (int i = 0; i < n; ++i)
    length.by[i] = (x.value * x.by[i] + y.value * y.by[i]) / r;
  return length;
}
template <int n, class S> bool isfinite(const Dual<n, S> &x)
{
  return std::isfinite(value_of(x));
}

/// How often a number type has been differentiated: 1 for Dual<n> and for a complex step, 2 for a Dual of Duals.
template <class T> constexpr int orders_of                    = 1;
template <int n, class S> constexpr int orders_of<Dual<n, S>> = 1 + orders_of<S>;
template <int n> constexpr int orders_of<Dual<n, double>>     = 1;
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
