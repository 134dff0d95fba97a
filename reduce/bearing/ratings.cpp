#include "reduce/bearing/ratings.h"
#include "reduce/bearing/geometry.h"
#include "reduce/bearing/roller_set.h"
#include <cmath>

namespace mill::bearing {
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
