#pragma once
#include "reduce/bite/slab/pass_inputs.h"

namespace mill::bite {
/// Says that the speeds do not settle. @throws SolverError always
[[noreturn]] void refuse_unsettled(double entry_speed, double roll_speed);

/// Contact in which the speed of the strip at the entry agrees with the neutral point it leads to: film and exit
/// point know the speed.  Newton in plain numbers from `speed` (which returns the result), then one step in T,
/// which carries the derivatives of the root exactly, (8.23); of second derivatives one step more.
///
/// @param in       the inputs in T
/// @param contact  (inputs, speed) -> a contact with a member entry_speed; callable for T and for Dual<1>
/// @throws SolverError  no rest after 60 steps
template <class T, class Contact>
auto settled_contact(const PassInputs<T> &in, double &speed, const Contact &contact)
{
  const PassInputs<Dual<1>> values = values_as<Dual<1>>(in);
  double slope                     = 0;
  for (int step = 0;; ++step) {
    const Dual<1> next = contact(values, Dual<1>::variable(speed, 0)).entry_speed;
    slope              = next.by[0];
    double change      = (next.value - speed) / (1 - slope);
    if (!(speed + change > 0))
      change = -0.5 * speed;  // a film that breaks down far from the root
    speed += change;
    if (slope == 0 || std::abs(change) <= 1e-15 * speed)
      break;
    if (!(step < 60) || !std::isfinite(speed)) {
      if (std::abs(change) <= 1e-13 * speed)
        break;
      refuse_unsettled(speed, values.roll_speed.value);
    }
  }
  const auto at_rest = contact(in, T(speed));
  // Nothing answers to the speed: Coulomb, gap at rest.  Its answer to a gap that moves still depends on the
  // speed.
  if (slope == 0 && orders_of<T> == 1)
    return at_rest;
  T settled = speed + (at_rest.entry_speed - speed) / (1 - slope);
  for (int order = 1; order < orders_of<T>; ++order)  // each step takes the derivatives one order further
    settled += (contact(in, settled).entry_speed - settled) / (1 - slope);
  return contact(in, settled);
}
}  // namespace mill::bite
