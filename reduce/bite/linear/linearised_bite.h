#pragma once
#include "reduce/bite/linear/linear_coefficients.h"
#include "reduce/bite/slab/bland_ford_equations.h"

// The linearisation of a solved bite in any number beneath, so that it can be differentiated once more.
// theory.md 8.9, 27.1
namespace mill::bite {
/// What the schemes of Linearisation hold.
template <class S> struct SteadyBite {
  S entry_speed, exit_speed;  ///< m/s
  S friction;                 ///< -
};

/// Quantities of a bite with their derivatives in the order of StripRow.
template <class S> struct LinearisedBite {
  BlandFordContact<Dual<5, S>> contact;
  Dual<5, S> force_per_width;  ///< N/m
};

/// @param laws  Strip, or StripLaws<Dual<5, S>>
/// @param in    inputs at the state; their derivatives by gap, gap rate, tensions and entry thickness are set here
template <class S, class Laws>
LinearisedBite<S> linearised_bite(const RollBite &bite, const Laws &laws, PassInputs<Dual<5, S>> in,
                                  const SteadyBite<S> &steady, const Linearisation scheme)
{
  using Number        = Dual<5, S>;
  const Input rows[5] = {Input::exit_thickness, Input::gap_rate, Input::entry_tension, Input::exit_tension,
                         Input::entry_thickness};
  for (int i = 0; i < 5; ++i)
    input(in, rows[i]).by[i] = 1;
  follow_entry(bite, in);
  LinearisedBite<S> b;
  if (scheme == Linearisation::implicit) {
    double speed = value_of(steady.entry_speed);
    b.contact    = settled_bland_ford(bite.strip, laws, in, speed);
  } else {
    const Number friction(steady.friction), exit_speed(steady.exit_speed);
    Held<Number> held;
    held.exit_speed = &exit_speed;
    held.friction   = scheme == Linearisation::frozen_friction ? &friction : nullptr;
    b.contact       = bland_ford_contact(laws, in, Number(steady.entry_speed), held);
  }
  const auto sides  = bland_ford_force(laws, in, b.contact, hill_rules(bite));
  b.force_per_width = sides.entry + sides.exit;
  return b;
}
}  // namespace mill::bite
