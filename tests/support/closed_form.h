#pragma once
#include <cmath>

/// Closed forms written apart from the product, for tests.
namespace closed_form {
/// Two long cylinders, same material, each loaded diametrically: Johnson, Contact Mechanics (1985),
/// eq. 4.43-4.45, 5.57. Per metre of length: q N/m, lengths m, stresses Pa, tangent N/m2.
struct Line {
  double half_width, peak_pressure, approach, tangent;
};
inline Line line_contact(const double q, const double D1, const double D2, const double E, const double nu)
{
  const double R1 = D1 / 2, R2 = D2 / 2, R = 1 / (1 / R1 + 1 / R2);
  const double plane = E / (1 - nu * nu) / 2;
  const double b     = std::sqrt(4 * q * R / (M_PI * plane));
  const auto body    = [&](const double radius) {
    return 2 * q * (1 - nu * nu) / (M_PI * E) * (std::log(4 * radius / b) - 0.5);
  };
  const double slope = 2 * (1 - nu * nu) / (M_PI * E) * (std::log(4 * R1 / b) + std::log(4 * R2 / b) - 2);
  return {b, 2 * q / (M_PI * b), body(R1) + body(R2), 1 / slope};
}
}  // namespace closed_form
