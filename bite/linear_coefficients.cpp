#include "bite/linear_coefficients.h"
#include "bite/bland_ford.h"
#include "bite/slab_checks.h"

namespace mill::bite {
LinearCoefficients linear_coefficients(const RollBite &bite, const BiteState &state, const Linearisation scheme)
{
  using Number = Dual<5>;
  check_pass(bite);
  check_coulomb(bite);
  if (std::isnan(bite.roll_speed))
    throw InputError("the coefficients of the vibrating bite need the speed of the rolls, which is not given");
  auto in             = pass_inputs<Number>(bite, state.flattened_radius);
  const Input rows[5] = {Input::exit_thickness, Input::gap_rate, Input::entry_tension, Input::exit_tension,
                         Input::entry_thickness};
  for (int i = 0; i < 5; ++i)
    input(in, rows[i]).by[i] = 1;
  follow_entry(bite, in);

  double speed = state.entry_speed;
  BlandFordContact<Number> c;
  if (scheme == Linearisation::implicit)
    c = settled_bland_ford(bite.strip, in, speed);
  else {
    const Number friction(state.friction), exit_speed(state.exit_speed);
    Held<Number> held;
    held.exit_speed = &exit_speed;
    held.friction   = scheme == Linearisation::frozen_friction ? &friction : nullptr;
    c               = bland_ford_contact(bite.strip, in, Number(speed), held);
  }
  const auto sides   = bland_ford_force(bite.strip, in, c, hill_rules(bite));
  const Number force = bite.strip.width * (sides.entry + sides.exit);
  return {c.entry_speed.by, c.exit_speed.by, force.by, c.friction.by, c.neutral_position.by};
}
}  // namespace mill::bite
