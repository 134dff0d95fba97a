#include "reduce/bite/linear/linear_sensitivity.h"
#include "core/base/errors.h"
#include "reduce/bite/linear/linearised_bite.h"
#include "reduce/bite/slab/flattening.h"
#include "reduce/bite/slab/slab_checks.h"
#include <algorithm>

namespace mill::bite {
namespace {
/// By the logarithms of all numbers of the pass.
using Direction = Dual<n_pass_numbers>;

Direction variable(const RollBite &bite, const PassNumber number)
{
  const double value = value_of(bite, number);
  return Direction::variable(value, int(number), value);
}

template <class T> StripLaws<T> directed_laws(const RollBite &bite)
{
  auto laws         = strip_laws<T>(bite.strip);
  const auto direct = [&](const auto &places, const PassNumber first) {
    for (std::size_t i = 0; i < places.size(); ++i)
      *places[i] = T(variable(bite, PassNumber(int(first) + int(i))));
  };
  direct(places_of_constants(laws.flow_stress), PassNumber::stress);
  direct(places_of_constants(laws.friction), PassNumber::friction);
  return laws;
}

template <class T> PassInputs<T> directed_inputs(const RollBite &bite, const Direction &radius)
{
  const auto entry_of = [&](const PassNumber number) { return T(variable(bite, number)); };
  auto in             = pass_inputs<T>(bite, radius.value);
  in.entry_thickness  = entry_of(PassNumber::entry_thickness);
  in.exit_thickness   = entry_of(PassNumber::exit_thickness);
  in.entry_tension    = entry_of(PassNumber::entry_tension);
  in.exit_tension     = entry_of(PassNumber::exit_tension);
  in.flow_stress      = entry_of(PassNumber::stress_factor);
  in.roll_speed       = entry_of(PassNumber::roll_speed);
  in.radius           = T(radius);
  if (!std::isnan(bite.strip.initial_thickness))
    in.initial_thickness = entry_of(PassNumber::initial_thickness);
  follow_entry(bite, in);
  return in;
}

/// Steady bite with R' following its force.
struct Steady {
  BlandFordContact<Direction> contact;
  Direction radius, force;
};

Steady steady_bite(const RollBite &bite, const BiteState &state)
{
  const auto laws         = directed_laws<Direction>(bite);
  const HillRules &rules  = hill_rules(bite);
  const Direction width   = variable(bite, PassNumber::width);
  const Direction poisson = variable(bite, PassNumber::poisson_ratio);
  const Direction reduction =
      variable(bite, PassNumber::entry_thickness) - variable(bite, PassNumber::exit_thickness);
  const Direction compliance =
      16.0 * (1.0 - poisson * poisson) / (M_PI * variable(bite, PassNumber::youngs_modulus) * width);
  double speed        = state.entry_speed;
  const auto value_at = [&](const Direction &radius) {
    Steady s;
    const auto in    = directed_inputs<Direction>(bite, radius);
    s.contact        = settled_bland_ford(bite.strip, laws, in, speed);
    const auto sides = bland_ford_force(laws, in, s.contact, rules);
    s.force          = width * (sides.entry + sides.exit);
    s.radius = variable(bite, PassNumber::roll_radius) * (1.0 + compliance * s.force / reduction);  // (8.9)
    return s;
  };
  // (27.2): one step from the root, where Phi(R') = R', with the slope of Phi.
  const Direction root  = value_at(Direction(state.flattened_radius)).radius;
  const double by_force = bite.roll_radius * compliance.value / reduction.value;
  const double slope    = by_force * by(state.force_by, Input::arc_radius);
  Direction radius(state.flattened_radius);
  for (int i = 0; i < n_pass_numbers; ++i)
    radius.by[i] = root.by[i] / (1 - slope);
  Steady s = value_at(radius);
  s.radius = radius;
  return s;
}
}  // namespace

LinearSensitivity linear_sensitivity(const RollBite &bite, const BiteState &state, const Linearisation scheme)
{
  check_pass(bite);
  check_coulomb(bite);
  if (std::isnan(bite.roll_speed))
    throw InputError("the coefficients of the vibrating bite need the speed of the rolls, which is not given");
  const Steady s = steady_bite(bite, state);
  LinearSensitivity d;
  d.flattened_radius = s.radius.by;
  d.friction         = s.contact.friction.by;
  d.force            = s.force.by;
  d.entry_speed      = s.contact.entry_speed.by;
  d.exit_speed       = s.contact.exit_speed.by;
  d.neutral_position = s.contact.neutral_position.by;
  if (has_film(bite.strip.friction))
    d.film_thickness = s.contact.film.by;

  using Number = Dual<5, Direction>;
  const auto b =
      linearised_bite<Direction>(bite, directed_laws<Number>(bite), directed_inputs<Number>(bite, s.radius),
                                 {s.contact.entry_speed, s.contact.exit_speed, s.contact.friction}, scheme);
  const auto &c    = b.contact;
  const auto force = Number(variable(bite, PassNumber::width)) * b.force_per_width;
  for (int p = 0; p < n_pass_numbers; ++p)
    for (int i = 0; i < 5; ++i) {
      d.by[p].entry_speed[i]      = c.entry_speed.by[i].by[p];
      d.by[p].exit_speed[i]       = c.exit_speed.by[i].by[p];
      d.by[p].force[i]            = force.by[i].by[p];
      d.by[p].friction[i]         = c.friction.by[i].by[p];
      d.by[p].neutral_position[i] = c.neutral_position.by[i].by[p];
    }
  return d;
}
}  // namespace mill::bite
