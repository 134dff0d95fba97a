#include "reduce/chain/line_contact.h"
#include "core/base/errors.h"
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
void require_positive(const CylinderPair &pair, const double load)
{
  if (!(pair.diameter1 > 0 && pair.diameter2 > 0 && pair.length > 0))
    throw InputError("line contact: both diameters and the contact length must be positive");
  if (!(load > 0))
    throw InputError("line contact: the load must be positive; without load neither contact nor stiffness exists");
}

/// 2 (1 - nu^2) / (pi E), 1/Pa: the compliance every law below is proportional to, (3.1)
double compliance(const Material &m)
{
  return 2 * (1 - m.poisson_ratio * m.poisson_ratio) / (M_PI * m.youngs_modulus);
}

double half_width(const CylinderPair &pair, const double q)
{
  const double R1 = pair.diameter1 / 2, R2 = pair.diameter2 / 2;
  return std::sqrt(4 * q * compliance(pair.material) * R1 * R2 / (R1 + R2));  // (3.2), 1/E' = pi A
}
}  // namespace

LineContact line_contact(const CylinderPair &pair, const double load)
{
  require_positive(pair, load);
  const double q = load / pair.length, A = compliance(pair.material);
  const double R1 = pair.diameter1 / 2, R2 = pair.diameter2 / 2;
  const double a     = half_width(pair, q);
  const double shape = std::log(16 * R1 * R2 / (a * a));
  LineContact contact;
  contact.half_width    = a;
  contact.peak_pressure = 2 * q / (M_PI * a);               // (3.3)
  contact.approach      = A * q * (shape - 1);              // (3.4)
  contact.secant        = load / contact.approach;          // (3.5a)
  contact.tangent       = pair.length / (A * (shape - 2));  // (3.5b): a^2 grows with q, so d(shape)/dq = -1/q
  return contact;
}

SecantLaws secant_laws(const CylinderPair &pair, const double load)
{
  require_positive(pair, load);
  const double q = load / pair.length, A = compliance(pair.material), a = half_width(pair, q);
  const double small  = std::min(pair.diameter1, pair.diameter2) / 2;
  const double foeppl = A * q * (2.0 / 3 + std::log(pair.diameter1 / a) + std::log(pair.diameter2 / a));  // (3.8)
  const double half   = A * q * std::log(8 * small * pair.length / (a * a));                              // (3.9)
  const double palmgren = 3.84e-8 * std::pow(load, 0.9) / std::pow(1e3 * pair.length, 0.8);               // (3.10)
  return {line_contact(pair, load).secant, load / foeppl, load / half, load / palmgren};
}
}  // namespace mill::reduce
