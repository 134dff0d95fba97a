#include "reduce/bite/slab/orowan.h"
#include <cmath>

namespace mill::bite {
double wedge_lever(const double phi)
{
  if (std::abs(phi) > 0.15)
    return 1 / phi - std::cos(phi) / std::sin(phi);
  const double q = phi * phi;  // coefficients 2^(2n) |B_2n| / (2n)!
  return phi *
         (1.0 / 3 +
          q * (1.0 / 45 + q * (2.0 / 945 + q * (1.0 / 4725 + q * (2.0 / 93555 + q * (1382.0 / 638512875.0))))));
}

namespace {
/// int_0^1 t^m sqrt(1 - a^2 t^2) dt by the series of the root, and a times its slope; a below 0.25.
double moment(const int m, const double a2, double &slope)
{
  double sum = 1.0 / (m + 1), term = 1;
  slope = 0;
  for (int j = 1; j < 14; ++j) {
    term *= a2 * (2 * j - 3) / (2.0 * j);
    const double part = term / (m + 2 * j + 1);
    sum += part;
    slope += 2 * j * part;
    if (std::abs(part) < 1e-18)
      break;
  }
  return sum;
}
}  // namespace

WedgeFactor wedge_factor(const double a, const double phi)
{
  const double a2 = a * a, q = phi * phi;
  // The moments from each other lose q/a^2 of their digits, the series is slow.
  const bool series = a < 1e-3 || (a < 0.25 && q > 4 * a2);
  const double root = std::sqrt(std::max(0.0, (1 - a) * (1 + a))), cube = root * root * root;
  double weight = 1, w = 0, by_a = 0, by_phi = 0;  // by_a: a times the slope, by_phi: phi times it
  double even = 0, slope = 0;
  for (int m = 0; m < 26; m += 2) {
    if (m > 0) {
      weight *= -q / (m * (m - 1));
      if (std::abs(weight) < 1e-18)
        break;
    }
    if (series)
      even = moment(m, a2, slope);
    else {  // parts: (m+2) a^2 I_m = (m-1) I_(m-2) - (1-a^2)^(3/2);  scaling: a I_m' = (1-a^2)^(1/2) - (m+1) I_m
      even  = m == 0 ? 0.5 * (root + std::asin(a) / a) : ((m - 1) * even - cube) / ((m + 2) * a2);
      slope = root - (m + 1) * even;
    }
    w += weight * even;
    by_a += weight * slope;
    by_phi += m * weight * even;
  }
  if (phi == 0)
    return {w, a > 0 ? by_a / a : 0, 0};
  const double widening = phi / std::sin(phi);
  return {w * widening, a > 0 ? by_a * widening / a : 0, (by_phi / phi + w * wedge_lever(phi)) * widening};
}
}  // namespace mill::bite
