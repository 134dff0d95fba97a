#include "reduce/bearing/asked_load.h"
#include "reduce/bearing/geometry.h"
#include "reduce/bearing/roller_profile.h"
#include <algorithm>
#include <cmath>

namespace mill::bearing {
RingLoading drive_of(const AskedLoad &asked, const double radial)
{
  auto loading = radial_drive(radial, asked.tilt);
  if (std::isfinite(asked.axial_displacement))
    loading.value[2] = asked.axial_displacement;
  else if (asked.axial != 0) {
    loading.value[2]      = asked.axial;
    loading.prescribed[2] = false;
  }
  if (std::isfinite(asked.moment)) {
    loading.value[4]      = asked.moment;
    loading.prescribed[4] = false;
  }
  return loading;
}

double roller_load_bound(const RollerBearing &b, const double radial_load, const double tilt)
{
  // Stribeck's number raised to 5 for clearance; tilted by 0.5 mrad one row of four carries two thirds of 1 MN and
  // all of 500 kN.
  const double even = 5 * radial_load / (b.rows * b.rollers_per_row * std::cos(b.cup_angle));
  // A crowned roller carries little loads on a short line: the patch serves at least a pressure of 1.5 GPa.
  constexpr double always = 1.5e9;
  double least            = 1e3;
  if (std::isfinite(b.roller_diameter) && std::isfinite(pitch_diameter(b))) {
    const double modulus = b.youngs_modulus / (2 * (1 - b.poisson_ratio * b.poisson_ratio));
    least                = M_PI * effective_radius(b, true) * always * always / modulus * b.roller_length;
  }
  const double bound = std::max(even * (tilt == 0 ? 2 : 4), least);
  return 1e3 * std::exp2(std::ceil(std::log2(bound / 1e3)));
}

double largest_roller_load(const RollerBearing &b, const AskedLoad &asked)
{
  double radial = asked.radial;
  for (const double load : asked.loads)
    radial = std::max(radial, load);
  double bound = roller_load_bound(b, radial, asked.tilt);
  if (asked.axial != 0)
    bound = std::max(bound, roller_load_bound(b, std::abs(asked.axial) / std::tan(b.cup_angle), asked.tilt));
  if (std::isfinite(asked.moment)) {
    // The rows stand apart by a quarter of the width, and lean: half of the smaller lever is on the safe side.
    const double R = pitch_diameter(b) / 2, lever = std::max(b.width / 8, R / 4);
    bound = std::max(bound, roller_load_bound(b, radial + std::abs(asked.moment) / lever, 0));
  }
  if (std::isfinite(asked.axial_displacement)) {
    const double approach = std::abs(asked.axial_displacement) * std::sin(b.cup_angle);
    const double each     = roller_constant(OneRollerLaw::iso, b.roller_length) * std::pow(approach, 10. / 9);
    const double even     = each * b.rows * b.rollers_per_row * std::cos(b.cup_angle) / 5;
    bound                 = std::max(bound, roller_load_bound(b, radial + even, asked.tilt));
  }
  return bound;
}
}  // namespace mill::bearing
