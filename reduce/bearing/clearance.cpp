#include "reduce/bearing/clearance.h"
#include "core/base/errors.h"
#include <cmath>

namespace mill::bearing {
double clearance_of_end_play(const double end_play, const double cup_angle)
{
  return end_play * std::tan(cup_angle);
}

double diametral_clearance(const RollerBearing &b)
{
  return std::isfinite(b.end_play) ? clearance_of_end_play(b.end_play, b.cup_angle) : b.radial_clearance;
}

double preloaded_roller(const RollerBearing &b)
{
  if (!std::isfinite(b.preload) || b.preload == 0)
    return 0;
  if (!(b.cup_angle > 0))
    throw InputError("bearing." + b.name + ": an axial preload needs a contact angle");
  return b.preload / (b.rollers_per_row * std::sin(b.cup_angle));
}

double approach_offset(const RollerBearing &b, const RollerLaw &law)
{
  const double preload = preloaded_roller(b);
  return preload > 0 ? roller_approach(law, preload) : -std::cos(b.cup_angle) * diametral_clearance(b) / 2;
}
}  // namespace mill::bearing
