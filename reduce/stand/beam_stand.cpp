#include "reduce/stand/beam_stand.h"
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
/// Factor on the sections of the backup roll that turns the drawn stiffness into the given one.
double given_factor(const FourHigh &stand, const double K_ZW)
{
  if (std::isnan(K_ZW))
    return 1;
  const SteppedBeam drawn = backup_beam(stand);
  return K_ZW *
         (stand.dynamics.mass_reference == MassReference::mean ? mean_flexibility(drawn) : mid_flexibility(drawn));
}
}  // namespace

StandModel beam_stand(const FourHigh &stand, const StandSprings &springs, const int elements)
{
  const double common = std::min(stand.work_roll.barrel_length, stand.backup_roll.barrel_length) / 2;
  const double factor = given_factor(stand, springs.K_ZW);
  const auto backup   = [&](const char *name) {
    return beam_roll(name, stand.backup_roll, stand.steel, elements, common, factor);
  };
  const auto work = [&](const char *name) {
    return beam_roll(name, stand.work_roll, stand.steel, elements, common);
  };
  return assemble_stand("beam", stand, springs,
                        {backup("upper backup roll"), work("upper work roll"), work("lower work roll"),
                         backup("lower backup roll")});
}
}  // namespace mill::reduce
