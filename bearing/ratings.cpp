#include "bearing/ratings.h"
#include "bearing/geometry.h"
#include "bearing/roller_set.h"
#include <cmath>

namespace mill::bearing {
double rating_factor(const double g)
{
  if (!(g > 0 && g < 1))
    throw InputError("bearing: roller diameter times cos(cup angle) over pitch diameter must lie between 0 and 1");
  const double ratio = (1 - g) / (1 + g);
  const double outer = std::pow(1.04 * std::pow(ratio, 143.0 / 108), 9.0 / 2);  // cup against cone
  return 207.9 * 0.83 * std::pow(g, 2.0 / 9) * std::pow(1 - g, 29.0 / 27) / std::pow(1 + g, 0.25) *
         std::pow(1 + outer, -2.0 / 9);
}

Ratings ratings(const RollerBearing &b)
{
  if (!(b.roller_diameter > 0 && pitch_diameter(b) > 0))
    throw InputError("bearing." + b.name + ": ratings need roller_diameter and a pitch diameter");
  const double ca = std::cos(b.cup_angle), cot = 1 / std::tan(b.cup_angle);
  const double D = 1e3 * b.roller_diameter, L = 1e3 * b.roller_length;  // the formulas hold in N and mm
  const double g = b.roller_diameter * ca / pitch_diameter(b), i = b.rows, Z = b.rollers_per_row;
  const double b_m = 1.1;  // tapered rollers of contemporary steel
  return {b_m * rating_factor(g) * std::pow(i * L * ca, 7.0 / 9) * std::pow(Z, 0.75) * std::pow(D, 29.0 / 27),
          44 * (1 - g) * i * Z * L * D * ca,
          1.5 * std::tan(b.cup_angle),
          0.4,
          0.4 * cot,
          0.45 * cot,
          0.67,
          0.67 * cot};
}

double friswell_stiffness(const RollerBearing &b, const double radial_load)
{
  if (!(radial_load > 0))
    throw InputError("bearing." + b.name + ": the stiffness formula needs a positive load");
  return 1e9 * std::pow(b.rows * b.rollers_per_row, 0.9) * std::pow(b.roller_length, 0.8) *
         std::pow(radial_load, 0.1) * std::pow(std::cos(b.cup_angle), 1.9);
}

DampingRange bearing_damping(const double stiffness)
{
  return {0.25e-5 * stiffness, 1.25e-5 * stiffness, 2.5e-5 * stiffness};
}

RollerLaw luo_law(const RollerBearing &b, const double inner_raceway, const double outer_raceway)
{
  const double nu = b.poisson_ratio, D = 1e3 * b.roller_diameter, L = 1e3 * b.roller_length;
  const double bodies = 2 * (1 - nu * nu) / (M_PI * b.youngs_modulus * 1e-6);  // mm^2/N: roller and raceway
  const auto contact  = [&](double curvature) {
    return 4.80 * std::pow(bodies, 0.9) * std::pow(1 + curvature, 0.1) / (std::pow(L, 0.74) * std::pow(D, 0.1));
  };
  const double ratio = roller_triangle(b, 1).cone;
  const double G     = contact(-b.roller_diameter / outer_raceway) + contact(b.roller_diameter / inner_raceway) *
                                                                     std::pow(ratio, 0.9) *
                                                                     std::cos(b.roller_cone_angle);
  RollerLaw law;
  law.position        = Eigen::VectorXd::Zero(1);
  law.drop            = Eigen::VectorXd::Zero(1);
  law.slice_length    = b.roller_length;
  law.lamina_constant = std::pow(1e3 / G, 10.0 / 9);  // N/mm^(10/9) -> N/m^(10/9)
  return law;
}
}  // namespace mill::bearing
