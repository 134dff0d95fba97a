#pragma once
#include <Eigen/Core>
#include <cmath>

/// Closed forms of the sample run's line contact: work roll on backup roll of the demo stand.  Written here a
/// second time on purpose: tests do not take their numbers from the product.  K. L. Johnson, Contact Mechanics
/// (1985), ch. 4, 5.
namespace sample {
constexpr double pi           = EIGEN_PI;
constexpr double E            = 210e9;  ///< Pa
constexpr double nu           = 0.28;
constexpr double D1           = 0.42;                          ///< m
constexpr double D2           = 1.45;                          ///< m
constexpr double L            = 1.4;                           ///< m
constexpr double A            = 2 * (1 - nu * nu) / (pi * E);  ///< 1/Pa
constexpr double working_load = 976217.5;                      ///< N
constexpr double softer       = 1.02;  ///< the sample's "computed" contact is this much softer than Hertz

inline double half_width(const double F)
{
  const double R = D1 * D2 / (2 * (D1 + D2));
  return std::sqrt(4 * (F / L) * R * 2 * (1 - nu * nu) / (pi * E));
}
inline double logarithm(const double F)
{
  return std::log(4 * D1 * D2 / (half_width(F) * half_width(F)));
}
inline double approach(const double F)
{
  return A * F / L * (logarithm(F) - 1);
}
inline double hertz_secant(const double F)
{
  return L / (A * (logarithm(F) - 1));
}
inline double hertz_tangent(const double F)
{
  return L / (A * (logarithm(F) - 2));
}
inline double foeppl_secant(const double F)
{
  const double b = 2 * half_width(F);
  return L / (A * (2.0 / 3 + std::log(2 * D1 / b) + std::log(2 * D2 / b)));
}
inline double half_space_secant(const double F)
{
  return L / (A * std::log(4 * D1 * L / (half_width(F) * half_width(F))));
}
inline double palmgren_secant(const double F)
{
  return F / (3.84e-5 * std::pow(F, 0.9) / std::pow(1e3 * L, 0.8) * 1e-3);
}
inline double peak_pressure(const double F)
{
  return 2 * F / L / (pi * half_width(F));
}
}  // namespace sample
