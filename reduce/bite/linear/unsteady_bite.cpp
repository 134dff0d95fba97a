#include "reduce/bite/linear/unsteady_bite.h"
#include "core/base/errors.h"
#include "reduce/bite/slab/bland_ford.h"
#include "reduce/bite/slab/slab_checks.h"
#include <algorithm>

namespace mill::bite {
namespace {
template <class T> struct Answer {
  BlandFordContact<T> contact;
  T force;
};

template <class T> PassInputs<T> inputs_at(const UnsteadyBite &u, const std::array<T, 5> &moment)
{
  auto in            = pass_inputs<T>(u.bite, u.flattened_radius);
  in.exit_thickness  = moment[0];
  in.gap_rate        = moment[1];
  in.entry_tension   = moment[2];
  in.exit_tension    = moment[3];
  in.entry_thickness = moment[4];
  follow_entry(u.bite, in);
  return in;
}

// Speed of the strip where a bite becomes zero: the one that the exit point knows.
double vanishing_speed(const UnsteadyBite &u)
{
  return u.scheme == Linearisation::implicit ? u.bite.roll_speed : u.steady_entry_speed;
}

// Rolls that close fast on a thin draft would press strip behind the line of centres that is thicker than at the
// entry.  There is none: the contact ends at -x_e at the latest, which limits the gap rate it knows, (26.2).
template <class T> void end_before_thick_strip(const UnsteadyBite &u, PassInputs<T> &in)
{
  using std::sqrt;
  const T room = in.radius * (4.0 * in.exit_thickness - 3.0 * in.entry_thickness);
  if (value_of(in.gap_rate) >= 0 || value_of(room) <= 0)
    return;
  const T entry   = sqrt(in.radius * (in.entry_thickness - in.exit_thickness));
  const T fastest = -2.0 * vanishing_speed(u) * entry * in.entry_thickness / room;
  if (in.gap_rate < fastest)
    in.gap_rate = fastest;
}

// Exit thickness by the steady speed: only for the edge at which a tension is too high.
template <class T> T exit_thickness(const UnsteadyBite &u, const PassInputs<T> &in)
{
  using std::sqrt;
  const T entry = sqrt(in.radius * (in.entry_thickness - in.exit_thickness));
  const T exit  = exit_position(in, entry, T(u.steady_entry_speed));
  return in.exit_thickness + exit * exit / in.radius;
}

template <class T> void keep_below_yield(const UnsteadyBite &u, PassInputs<T> &in)
{
  const FlowStress &law = u.bite.strip.flow_stress;
  const T entry         = tension_limit * stress_at(law, in, in.entry_thickness),
          exit          = tension_limit * stress_at(law, in, exit_thickness(u, in));
  if (in.entry_tension > entry)
    in.entry_tension = entry;
  if (in.exit_tension > exit)
    in.exit_tension = exit;
}

template <class T> PassInputs<T> limited_inputs(const UnsteadyBite &u, const std::array<T, 5> &moment)
{
  PassInputs<T> in = inputs_at(u, moment);
  end_before_thick_strip(u, in);
  keep_below_yield(u, in);
  return in;
}

template <class T> BlandFordContact<T> contact_at(const UnsteadyBite &u, const PassInputs<T> &in)
{
  const Strip &strip = u.bite.strip;
  if (u.scheme == Linearisation::implicit) {
    double speed = u.steady_entry_speed;
    return settled_bland_ford(strip, in, speed);
  }
  const T friction(u.steady_friction), exit_speed(u.steady_exit_speed);
  Held<T> held;
  held.exit_speed = &exit_speed;
  held.friction   = u.scheme == Linearisation::frozen_friction ? &friction : nullptr;
  return bland_ford_contact(strip, in, T(u.steady_entry_speed), held);
}

template <class T> Answer<T> answer_at(const UnsteadyBite &u, const std::array<T, 5> &moment)
{
  const PassInputs<T> in = limited_inputs(u, moment);
  Answer<T> a;
  a.contact        = contact_at(u, in);
  const auto sides = bland_ford_force(u.bite.strip, in, a.contact, u.rules);
  a.force          = u.bite.strip.width * (sides.entry + sides.exit);
  return a;
}

BiteAnswer untouched(const UnsteadyBite &u)
{
  BiteAnswer a;
  a.entry_speed = a.exit_speed = u.bite.roll_speed;
  a.contact                    = false;
  return a;
}

template <class T> BiteAnswer plain(const Answer<T> &a)
{
  const BlandFordContact<T> &c = a.contact;
  BiteAnswer p;
  p.entry_speed      = value_of(c.entry_speed);
  p.exit_speed       = value_of(c.exit_speed);
  p.force            = value_of(a.force);
  p.friction         = value_of(c.friction);
  p.film_thickness   = value_of(c.film);
  p.neutral_position = value_of(c.neutral_position);
  p.exit_position    = value_of(c.exit_position);
  p.from_exit        = c.free_neutral_angle - value_of(c.exit_angle);
  p.from_entry       = value_of(c.entry_angle) - c.free_neutral_angle;
  return p;
}
}  // namespace

UnsteadyBite unsteady_bite(const RollBite &bite, const BiteState &state, const Linearisation scheme)
{
  check_pass(bite);
  check_coulomb(bite);
  if (std::isnan(bite.roll_speed))
    throw InputError("the vibrating bite needs the speed of the rolls, which is not given");
  UnsteadyBite u;
  u.bite               = bite;
  u.scheme             = scheme;
  u.flattened_radius   = state.flattened_radius;
  u.steady_entry_speed = state.entry_speed;
  u.steady_exit_speed  = state.exit_speed;
  u.steady_friction    = state.friction;
  u.rules              = hill_rules(bite);
  return u;
}

Moment steady_moment(const UnsteadyBite &u)
{
  const Strip &s = u.bite.strip;
  return {s.exit_thickness, u.bite.gap_rate, s.entry_tension, s.exit_tension, s.entry_thickness};
}

BiteAnswer bite_at(const UnsteadyBite &u, const Moment &moment)
{
  return contact_reserve(u, moment) > 0 ? plain(answer_at<double>(u, moment)) : untouched(u);
}

BiteSlopes bite_slopes_at(const UnsteadyBite &u, const Moment &moment)
{
  if (!(contact_reserve(u, moment) > 0))
    return {untouched(u), {}};
  using Number = Dual<5>;
  std::array<Number, 5> variables;
  for (int i = 0; i < 5; ++i)
    variables[i] = Number::variable(moment[i], i);
  const auto a = answer_at<Number>(u, variables);
  return {plain(a),
          {a.contact.entry_speed.by, a.contact.exit_speed.by, a.force.by, a.contact.friction.by,
           a.contact.neutral_position.by}};
}

std::array<double, 2> neutral_reserve(const UnsteadyBite &u, const Moment &moment)
{
  if (!(contact_reserve(u, moment) > 0))
    return {1, 1};
  const auto c = contact_at(u, limited_inputs(u, moment));
  return {c.free_neutral_angle - c.exit_angle, c.entry_angle - c.free_neutral_angle};
}

double contact_reserve(const UnsteadyBite &u, const Moment &moment)
{
  const double opening = std::max(moment[1], 0.) / vanishing_speed(u);
  return moment[4] - moment[0] - 0.25 * u.flattened_radius * opening * opening;
}

std::array<double, 2> yield_reserve(const UnsteadyBite &u, const Moment &moment)
{
  const auto in         = inputs_at(u, moment);
  const FlowStress &law = u.bite.strip.flow_stress;
  const double h        = std::min(exit_thickness(u, in), in.entry_thickness);
  return {1 - in.entry_tension / (tension_limit * stress_at(law, in, in.entry_thickness)),
          1 - in.exit_tension / (tension_limit * stress_at(law, in, std::isfinite(h) ? h : in.entry_thickness))};
}
}  // namespace mill::bite
