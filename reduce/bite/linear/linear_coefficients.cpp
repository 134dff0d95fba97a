#include "reduce/bite/linear/linear_coefficients.h"
#include "core/base/errors.h"
#include "reduce/bite/linear/linearised_bite.h"
#include "reduce/bite/slab/slab_checks.h"

namespace mill::bite {
LinearCoefficients linear_coefficients(const RollBite &bite, const BiteState &state, const Linearisation scheme)
{
  check_pass(bite);
  check_coulomb(bite);
  if (std::isnan(bite.roll_speed))
    throw InputError("the coefficients of the vibrating bite need the speed of the rolls, which is not given");
  const auto in = pass_inputs<Dual<5>>(bite, state.flattened_radius);
  const auto b =
      linearised_bite<double>(bite, bite.strip, in, {state.entry_speed, state.exit_speed, state.friction}, scheme);
  const auto &c       = b.contact;
  const Dual<5> force = bite.strip.width * b.force_per_width;
  return {c.entry_speed.by, c.exit_speed.by, force.by, c.friction.by, c.neutral_position.by};
}
}  // namespace mill::bite
