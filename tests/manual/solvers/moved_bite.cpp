#include "tests/manual/solvers/moved_bite.h"

namespace mill::bite {
RollBite moved_bite(RollBite bite, const Input input, const double by)
{
  Strip &s = bite.strip;
  switch (input) {
  case Input::entry_thickness:
    s.entry_thickness += by;
    break;
  case Input::exit_thickness:
    s.exit_thickness += by;
    break;
  case Input::entry_tension:
    s.entry_tension += by;
    break;
  case Input::exit_tension:
    s.exit_tension += by;
    break;
  case Input::friction:
    s.friction.coefficient += by;
    s.friction.mu0 += by;
    s.friction.at_unit_speed += by;
    s.friction.entry_factor += by;
    s.friction.exit_factor += by;
    break;
  case Input::flow_stress:
    s.flow_stress.k *= 1 + by;
    s.flow_stress.k0 *= 1 + by;
    break;
  case Input::arc_radius:
    bite.roll_radius += by;
    break;
  case Input::roll_speed:
    bite.roll_speed += by;
    break;
  case Input::gap_rate:
    bite.gap_rate += by;
    break;
  }
  return bite;
}
}  // namespace mill::bite
