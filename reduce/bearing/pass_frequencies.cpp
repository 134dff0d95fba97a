#include "reduce/bearing/pass_frequencies.h"
#include <cmath>

namespace mill::bearing {
namespace {
PassFrequencies with_cage(const RollerBearing &b, const double cage, const double roller)
{
  return {cage, b.rollers_per_row * cage, b.rollers_per_row * (1 - cage), roller};
}
}  // namespace

PassFrequencies pass_frequencies(const RollerBearing &b)
{
  const double mean_angle = b.cup_angle - b.roller_cone_angle / 2, D_pw = pitch_diameter(b);
  const double gamma = b.roller_diameter / D_pw * std::cos(mean_angle);
  return with_cage(b, (1 - gamma) / 2, D_pw / (2 * b.roller_diameter) * (1 - gamma * gamma));  // (32.10)
}

PassFrequencies of_rolling_cones(const RollerBearing &b)
{
  if (!(b.roller_cone_angle > 0))
    return with_cage(b, not_given, not_given);
  const double outer = std::sin(b.cup_angle), inner = std::sin(b.cup_angle - b.roller_cone_angle);
  const double cage = inner / (inner + outer);
  return with_cage(b, cage, cage * outer / std::sin(b.roller_cone_angle / 2));  // (32.11)
}
}  // namespace mill::bearing
