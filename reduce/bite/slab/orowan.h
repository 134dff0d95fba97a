#pragma once
#include "core/laws/flow_stress_law.h"
#include "core/numerics/derivative.h"

// Stress in a wedge of plastic material between two rough plates: what makes Orowan's theory inhomogeneous.
// theory.md 17.2
namespace mill::bite {
/// 1/phi - cot(phi), by its series where both terms nearly cancel.  phi in rad, |phi| < pi.
double wedge_lever(double phi);

/// Mean horizontal stress that yielding adds to the pressure, over the flow stress k, with its two slopes.
struct WedgeFactor {
  double value;     ///< -, w(a, phi) of (17.4): w(0, phi) = 1, w(1, 0) = pi/4
  double by_shear;  ///< -, dw/da
  double by_angle;  ///< 1/rad, dw/dphi
};

/// w(a, phi) of (17.4); for parallel plates w = (sqrt(1 - a^2) + asin(a)/a)/2.
/// The cosine under the integral is expanded; the moments of sqrt(1 - a^2 t^2) over 0..1 follow from each other,
/// for small a from the series of the root.  The slopes are by-products of the same sums.  To rounding for phi
/// below 1.
/// @param a    -, shear at the plates over the shear yield stress, 0 <= a <= 1
/// @param phi  rad, half angle of the wedge, 0 <= phi < pi
/// Cost some 50 ns.
WedgeFactor wedge_factor(double a, double phi);

/// The same for numbers with derivatives.
template <int n> Dual<n> wedge_lever(const Dual<n> &phi)
{
  const double lever = wedge_lever(phi.value);
  // From the definition: lever' = 1 + lever^2 - 2 lever/phi, without cancellation.
  return chain(phi, lever, phi.value == 0 ? 1.0 / 3 : 1 + lever * (lever - 2 / phi.value));
}
inline double wedge_number(const WedgeFactor &w, double, double)
{
  return w.value;
}
template <int n> Dual<n> wedge_number(const WedgeFactor &w, const Dual<n> &a, const Dual<n> &phi)
{
  Dual<n> sum = chain(a, w.value, w.by_shear);
  for (int i = 0; i < n; ++i)
    sum.by[i] += w.by_angle * phi.by[i];
  return sum;
}
template <class T> T wedge_value(const T &a, const T &phi)
{
  return wedge_number(wedge_factor(value_of(a), value_of(phi)), a, phi);
}
}  // namespace mill::bite
