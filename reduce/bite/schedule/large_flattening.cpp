#include "reduce/bite/schedule/large_flattening.h"
#include "core/base/errors.h"
#include "reduce/bite/schedule/arc_force.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/flattening.h"
#include <cmath>

namespace mill::bite {
double flattened_radius_under(const RollBite &bite, const double force)
{
  const double line = hitchcock_radius(bite, force), load = line / bite.roll_radius - 1;
  return line <= largest_of_hitchcock * bite.roll_radius ? line : 2 * bite.roll_radius * std::pow(load, 2.0 / 3.0);
}

FlattenedPass flattened_pass(const RollBite &bite, const Theory theory)
{
  constexpr double limit = 20;  // R'/R, as for Hitchcock's formula
  FlattenedPass pass{bite.roll_radius, 0};
  for (int step = 0; step < 2000; ++step) {
    pass.force        = force_on_arc(bite, theory, pass.radius);
    const double next = flattened_radius_under(bite, pass.force);
    if (std::abs(next - pass.radius) <= 1e-14 * next)
      return pass;
    if (!(next <= limit * bite.roll_radius))
      break;
    pass.radius = next;
  }
  throw SolverError(
      {"roll bite: no flattened radius with the power 2/3 beyond Hitchcock's range",
       sentence("R'/R = ", pass.radius / bite.roll_radius, ", force there ", pass.force / 1e3, " kN"),
       "the strip is too thin or too hard for this roll",
       "a smaller work roll, less friction or more "
       "tension",
       ""});
}
}  // namespace mill::bite
