#include "fem/contact/hertz.h"
#include "core/base/errors.h"
#include "core/numerics/root_search.h"
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::contact {
namespace {
constexpr double unknown  = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

// Complete elliptic integrals of modulus k, k^2 = 1 - ratio^2, in the three forms that do not cancel:
//     K ,   D = (K - E) / k^2 ,   B = K - D = (E - ratio^2 K) / k^2
struct EllipticIntegrals {
  double K, D, B;
};

EllipticIntegrals elliptic_integrals(const double ratio)
{
  // Arithmetic-geometric mean of 1 and ratio.  c_0 = k, c_(n+1) = (a_n - b_n) / 2, E = K (1 - sum 2^(n-1) c_n^2);
  // the term of c_0 is the 1/2 of D / K, and c_1^2 / k^2 = (1 - ratio) / (4 (1 + ratio)).
  double a = 1, b = ratio, sum = 0, weight = 1;
  double c2 = (1 - ratio) / (4 * (1 + ratio));  // c_n^2 / k^2
  for (int n = 1; n < 40 && c2 > 0; ++n) {
    sum += weight * c2;
    weight *= 2;
    const double mean = (a + b) / 2;
    b                 = std::sqrt(a * b);
    a                 = mean;
    const double c    = (a - b) / 2;
    c2                = a - b > 1e-16 * a ? c * c / ((1 - ratio) * (1 + ratio)) : 0;
  }
  const double K = M_PI / (2 * a);
  return {K, K * (0.5 + sum), K * (0.5 - sum)};
}

// Ratio of the semi-axes, minor to major, for a ratio of the radii >= 1.  B / (ratio^2 D) falls from infinity to 1
// as the ratio of the axes grows to 1, and the axes differ less than the radii do.
double axis_ratio(const double radii)
{
  const auto excess = [&](const double log_ratio) {
    const double ratio        = std::exp(log_ratio);
    const EllipticIntegrals e = elliptic_integrals(ratio);
    return e.B / (ratio * ratio * e.D) / radii - 1;
  };
  return std::exp(root_between(-std::log(radii), 0, excess).value_or(0));  // 0: radii that differ by rounding
}
}  // namespace

PointContact hertz_point(const double load, const double radius_x, const double radius_y, const double modulus)
{
  require_input(load > 0 && radius_x > 0 && radius_y > 0 && modulus > 0,
                "Hertz contact: load, both radii and the modulus must be positive");
  const double larger       = std::max(radius_x, radius_y);
  const double ratio        = axis_ratio(larger / std::min(radius_x, radius_y));
  const EllipticIntegrals e = elliptic_integrals(ratio);
  const double a            = std::cbrt(3 * load * larger * e.D / (M_PI * modulus));
  const double b            = ratio * a;
  PointContact c;
  c.load          = load;
  c.semi_x        = radius_x >= radius_y ? a : b;
  c.semi_y        = radius_x >= radius_y ? b : a;
  c.peak_pressure = 3 * load / (2 * M_PI * a * b);
  c.approach      = c.peak_pressure * b * e.K / modulus;
  c.secant        = load / c.approach;
  c.tangent       = 1.5 * c.secant;
  return c;
}

PointContact hertz_point_at(const double approach, const double radius_x, const double radius_y,
                            const double modulus)
{
  require_input(approach > 0, "Hertz contact: the approach must be positive");
  // The approach grows with the power 2/3 of the load, so one load gives all others.
  const double unit          = modulus * radius_x * radius_y;
  const double unit_approach = hertz_point(unit, radius_x, radius_y, modulus).approach;
  return hertz_point(unit * std::pow(approach / unit_approach, 1.5), radius_x, radius_y, modulus);
}

HertzLine hertz_line(const double line_load, const double radius, const double modulus)
{
  require_input(line_load > 0 && radius > 0 && modulus > 0,
                "Hertz contact: line load, radius and modulus must be positive");
  const double b = std::sqrt(4 * line_load * radius / (M_PI * modulus));
  return {b, 2 * line_load / (M_PI * b)};
}

double cylinder_approach(const double line_load, const double radius, const double half_width, const Material &m)
{
  require_input(line_load > 0 && radius > 0 && half_width > 0 && m.youngs_modulus > 0,
                "cylinder: line load, radius, half width and modulus must be positive");
  const double compliance = 2 * (1 - m.poisson_ratio * m.poisson_ratio) / (M_PI * m.youngs_modulus);
  return compliance * line_load * (std::log(4 * radius / half_width) - 0.5);
}

PartialSlip cattaneo_line(const HertzLine &contact, const double load_ratio)
{
  require_input(load_ratio >= 0 && load_ratio <= 1, "partial slip: Q / (mu P) must be in 0 .. 1");
  return {contact.half_width * std::sqrt(1 - load_ratio), unknown, unknown};
}

double cattaneo_traction(const HertzLine &contact, const PartialSlip &slip, const double mu, const double x)
{
  const double b = contact.half_width, c = slip.stick;
  const double sliding = std::sqrt(std::max(0., 1 - (x / b) * (x / b)));
  const double held    = std::abs(x) < c ? c / b * std::sqrt(1 - (x / c) * (x / c)) : 0;
  return mu * contact.peak_pressure * (sliding - held);
}

PartialSlip mindlin_sphere(const PointContact &contact, const HalfSpaces &bodies, const double mu,
                           const double load_ratio)
{
  require_input(load_ratio >= 0 && load_ratio <= 1, "partial slip: Q / (mu P) must be in 0 .. 1");
  require_input(std::abs(contact.semi_x - contact.semi_y) <= 1e-9 * contact.semi_x,
                "partial slip: Mindlin's closed form is that of a circular contact");
  const double a         = contact.semi_x;
  const double shear_sum = 2 * M_PI * (2 * bodies.shear + bodies.along);  // sum of (2 - nu) / G
  const double remaining = 1 - load_ratio;
  return {a * std::cbrt(remaining),
          3 * mu * contact.load / (16 * a) * shear_sum * (1 - std::cbrt(remaining * remaining)),
          8 * a / shear_sum};
}

EllipticSlip mindlin_ellipse(const PointContact &contact, const HalfSpaces &bodies, const double mu,
                             const double load_ratio, const bool along_y)
{
  require_input(load_ratio >= 0 && load_ratio <= 1, "partial slip: Q / (mu P) must be in 0 .. 1");
  const double a = std::max(contact.semi_x, contact.semi_y), b = std::min(contact.semi_x, contact.semi_y);
  const EllipticIntegrals e = elliptic_integrals(b / a);
  const bool along_major    = along_y == (contact.semi_y >= contact.semi_x);
  // (33.8): whole ellipse stuck
  const double compliance = (bodies.shear * e.K + bodies.along * (along_major ? e.D : e.B)) / a;
  const double remaining = 1 - load_ratio, shrink = std::cbrt(remaining);
  return {contact.semi_x * shrink, contact.semi_y * shrink,
          1.5 * mu * contact.load * compliance * (1 - shrink * shrink), 1 / compliance};
}

FiniteLine lundberg_line(const HertzLine &contact, const double line_load, const double length,
                         const double modulus)
{
  require_input(line_load > 0 && modulus > 0 && length > 2 * contact.half_width,
                "finite line: load and modulus must be positive, and the line longer than the contact is wide");
  const double log      = std::log(2 * length / contact.half_width);
  const double approach = 2 * line_load / (M_PI * modulus) * (log + 0.5);
  return {approach, line_load * length / approach, length * M_PI * modulus / (2 * log)};
}

CircularPunch circular_punch(const double load, const double radius, const double modulus)
{
  require_input(load > 0 && radius > 0 && modulus > 0, "punch: load, radius and modulus must be positive");
  const double k = 2 * radius * modulus;
  return {load / k, k, load / (M_PI * radius * radius)};
}

double circular_punch_pressure(const double load, const double radius, const double r)
{
  const double depth = (radius - std::abs(r)) * (radius + std::abs(r));
  return depth < 0 ? 0 : depth == 0 ? infinite : load / (2 * M_PI * radius * std::sqrt(depth));
}

double strip_punch_pressure(const double line_load, const double half_width, const double x)
{
  const double depth = (half_width - std::abs(x)) * (half_width + std::abs(x));
  return depth < 0 ? 0 : depth == 0 ? infinite : line_load / (M_PI * std::sqrt(depth));
}
}  // namespace mill::contact
