#include "reduce/bearing/pass_frequencies.h"
#include <cmath>

namespace mill::bearing {
namespace {
PassFrequencies with_cage(const int elements, const double cage, const double element)
{
  return {cage, elements * cage, elements * (1 - cage), element};
}
}  // namespace

PassFrequencies pass_frequencies(const int elements, const double diameter, const double pitch,
                                 const double contact_angle)
{
  const double gamma = diameter / pitch * std::cos(contact_angle);
  return with_cage(elements, (1 - gamma) / 2, pitch / (2 * diameter) * (1 - gamma * gamma));  // (32.10)
}

PassFrequencies pass_frequencies(const RollerBearing &b)
{
  return pass_frequencies(b.rollers_per_row, b.roller_diameter, pitch_diameter(b),
                          b.cup_angle - b.roller_cone_angle / 2);
}

PassFrequencies of_rolling_cones(const RollerBearing &b)
{
  if (!(b.roller_cone_angle > 0))
    return with_cage(b.rollers_per_row, not_given, not_given);
  const double outer = std::sin(b.cup_angle), inner = std::sin(b.cup_angle - b.roller_cone_angle);
  const double cage = inner / (inner + outer);
  return with_cage(b.rollers_per_row, cage, cage * outer / std::sin(b.roller_cone_angle / 2));  // (32.11)
}
}  // namespace mill::bearing
