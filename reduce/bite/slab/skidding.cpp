#include "reduce/bite/slab/skidding.h"
#include "reduce/bite/slab/karman_arc.h"
#include <cmath>

namespace mill::bite {
double friction_margin(const RollBite &bite, const double radius, const double mu)
{
  KarmanOptions quick;
  quick.derivatives = false;
  quick.points      = 0;
  quick.tolerance   = 1e-6;
  const auto skids  = [&](const double multiple) {
    RollBite other = bite;
    other.strip.friction.entry_factor *= multiple;
    other.strip.friction.exit_factor *= multiple;
    return solve_on_circle(other, Theory::karman, radius, mu * multiple, quick).skids;
  };
  double low = 1, high = 1;  // skids at the one, holds at the other
  if (skids(1))
    for (; high < 1e3 && skids(high); high *= 1.5)
      low = high;
  else
    for (; low > 1e-3 && !skids(low); low /= 1.5)
      high = low;
  while (high > 1.01 * low) {
    const double middle          = std::sqrt(low * high);
    (skids(middle) ? low : high) = middle;
  }
  return 1 / high;
}
}  // namespace mill::bite
