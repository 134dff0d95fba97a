#include "curve_stand.h"

namespace mill::dynamics {
SpringForce beyond_tangent(const CurveStand &stand, const CurveSpring &spring, const double d)
{
  const SpringForce here = stand.laws[spring.law].at(spring.rest + d);
  return {spring.share * (here.force - spring.force - spring.stiffness * d),
          spring.share * (here.stiffness - spring.stiffness)};
}

double energy_beyond_tangent(const CurveStand &stand, const CurveSpring &spring, const double d)
{
  const SpringLaw &law = stand.laws[spring.law];
  return spring.share * (law.energy(spring.rest + d) - law.energy(spring.rest) - spring.force * d -
                         0.5 * spring.stiffness * d * d);
}

double further_compression(const CurveSpring &spring, const double *q)
{
  double d = 0;
  for (std::size_t k = 0; k < spring.row.size(); ++k)
    d += spring.row[k] * q[k];
  return d;
}

double energy_of(const CurveStand &stand, const double *q, const double *rate_of_q)
{
  double sum = 0;
  for (std::size_t k = 0; k < stand.modes(); ++k)
    sum += 0.5 * (rate_of_q[k] * rate_of_q[k] + stand.rate[k] * stand.rate[k] * q[k] * q[k]);
  for (const CurveSpring &spring : stand.springs)
    sum += energy_beyond_tangent(stand, spring, further_compression(spring, q));
  return sum;
}
}  // namespace mill::dynamics
