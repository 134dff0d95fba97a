#pragma once
#include <Eigen/Core>
#include <cmath>

// A number with as many derivatives as the arc has points; known only to the elastic arc.
namespace mill::bite {
/// Like Dual, with a length known at run time; an empty row of derivatives is a constant.
struct Row {
  double value = 0;   ///< unit of the quantity
  Eigen::ArrayXd by;  ///< its derivatives

  Row() = default;
  Row(const double constant) : value(constant) {}  // implicit on purpose: constants mix with numbers
  Row(const double v, Eigen::ArrayXd derivatives) : value(v), by(std::move(derivatives)) {}
  static Row variable(const double value, const Eigen::Index direction, const Eigen::Index n)
  {
    Row x(value, Eigen::ArrayXd::Zero(n));
    x.by[direction] = 1;
    return x;
  }
};

inline double value_of(const Row &x)
{
  return x.value;
}

/// a x + b y of derivatives, constants left out
inline Eigen::ArrayXd combined(const double a, const Eigen::ArrayXd &x, const double b, const Eigen::ArrayXd &y)
{
  if (x.size() == 0)
    return y.size() == 0 ? y : Eigen::ArrayXd(b * y);
  if (y.size() == 0)
    return a * x;
  return a * x + b * y;
}

inline Row operator+(const Row &x, const Row &y)
{
  return {x.value + y.value, combined(1, x.by, 1, y.by)};
}
inline Row operator-(const Row &x, const Row &y)
{
  return {x.value - y.value, combined(1, x.by, -1, y.by)};
}
inline Row operator-(const Row &x)
{
  return {-x.value, -x.by};
}
inline Row operator*(const Row &x, const Row &y)
{
  return {x.value * y.value, combined(y.value, x.by, x.value, y.by)};
}
inline Row operator/(const Row &x, const Row &y)
{
  const double q = x.value / y.value;
  return {q, combined(1 / y.value, x.by, -q / y.value, y.by)};
}
inline bool operator<(const Row &x, const Row &y)
{
  return x.value < y.value;
}
inline bool operator>(const Row &x, const Row &y)
{
  return x.value > y.value;
}
inline Row row_of(const Row &x, const double value, const double slope)
{
  return {value, slope * x.by};
}
inline Row sqrt(const Row &x)
{
  return row_of(x, std::sqrt(x.value), 0.5 / std::sqrt(x.value));
}
inline Row exp(const Row &x)
{
  return row_of(x, std::exp(x.value), std::exp(x.value));
}
inline Row expm1(const Row &x)
{
  return row_of(x, std::expm1(x.value), std::exp(x.value));
}
inline Row log(const Row &x)
{
  return row_of(x, std::log(x.value), 1 / x.value);
}
inline Row pow(const Row &x, const double n)
{
  if (x.by.size() == 0 || x.value <= 0)
    return Row(std::pow(x.value, n));
  return row_of(x, std::pow(x.value, n), n * std::pow(x.value, n - 1));
}
}  // namespace mill::bite
