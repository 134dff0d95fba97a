#include "reduce/bearing/oil_film/closed_forms.h"
#include "core/base/errors.h"
#include "core/numerics/root_search.h"
#include <cmath>

namespace mill::bearing {
namespace {
void require_ratio(const double e)
{
  require_input(e >= 0 && e < 1, "an eccentricity ratio lies between 0 and 1");
}

}  // namespace

// (29.13)
double ocvirk_force(const double length_ratio, const double e)
{
  require_ratio(e);
  const double u = 1 - e * e;
  return 2 * length_ratio * length_ratio * e * std::sqrt(16 * e * e + M_PI * M_PI * u) / (u * u);
}

double ocvirk_attitude(const double e)
{
  require_ratio(e);
  return std::atan2(M_PI * std::sqrt(1 - e * e), 4 * e);
}

double ocvirk_eccentricity(const double length_ratio, const double force)
{
  constexpr double low = 1e-9, high = 1 - 1e-9;
  const auto excess = [&](const double e) { return ocvirk_force(length_ratio, e) - force; };
  return root_between(low, high, excess).value_or(excess(low) > 0 ? low : high);
}

// (29.14), of a film whose force is 4 (L/D)^2 (r, t) in the directions of the line of centres and of rotation
ClosedCoefficients ocvirk_coefficients(const double e)
{
  require_ratio(e);
  require_input(e > 0, "a concentric short bearing has no line of centres");
  const double u = 1 - e * e;
  const double r = 2 * e * e / (u * u), t = -M_PI / 2 * e * std::pow(u, -1.5);
  const double r_slope = 4 * e * (1 + e * e) / (u * u * u),
               t_slope = -M_PI / 2 * (1 + 2 * e * e) * std::pow(u, -2.5);
  const double mixed   = -2 * e / (u * u);
  Eigen::Matrix2d stiffness, damping, axes;
  stiffness << r_slope, -t / e, t_slope, r / e;
  damping << M_PI * (1 + 2 * e * e) * std::pow(u, -2.5), 2 * mixed, 2 * mixed, M_PI * std::pow(u, -1.5);
  const double force = std::hypot(r, t);
  axes << r, -t, t, r;  // along the load and 90 degrees on
  axes /= force;
  return {axes.transpose() * stiffness * axes / force, axes.transpose() * damping * axes / force};
}

double sommerfeld_force(const double e)
{
  require_ratio(e);
  return 2 * 12 * M_PI * e / ((2 + e * e) * std::sqrt(1 - e * e));
}

double petroff_friction()
{
  return 4 * M_PI;
}
}  // namespace mill::bearing
