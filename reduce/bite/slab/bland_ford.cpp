#include "reduce/bite/slab/bland_ford.h"
#include "core/base/errors.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/curves.h"
#include "reduce/bite/slab/flattening.h"
#include "reduce/bite/slab/slab_checks.h"
#include <algorithm>

namespace mill::bite {
namespace {
using Number = Dual<n_inputs>;

/// There must be a point inside the arc at which strip and roll run equally fast.
void require_neutral_point(const RollBite &bite, const BlandFordContact<Number> &c, const double radius)
{
  const double exit = c.exit_angle.value, entry = c.entry_angle.value;
  if (c.free_neutral_angle > exit && c.free_neutral_angle < entry)
    return;
  const Strip &s      = bite.strip;
  const double H      = 2 * std::sqrt(radius / s.exit_thickness) * (entry - exit);  // of (8.3), from exit to entry
  const double needed = std::abs(c.balance) / H;
  const double angle  = std::sqrt((s.entry_thickness - s.exit_thickness) / radius);
  refuse_neutral_point(friction_in_words(s.friction, c.friction.value), angle, needed,
                       c.free_neutral_angle <= exit);
}

/// Pressure and friction stress along the arc.
void sample(BiteState &state, const RollBite &bite, const PassInputs<double> &in,
            const BlandFordContact<double> &c, const int points)
{
  const double scale     = std::sqrt(in.radius * in.exit_thickness);
  const double per_angle = 2 * c.friction * std::sqrt(in.radius / in.exit_thickness);
  const double entry = c.entry_factor / in.entry_thickness, exit = c.exit_factor / c.exit_thickness;
  const auto value_at = [&](const double x, const bool entry_side) {  // (8.5), (8.6)
    const double h = in.exit_thickness + x * x / in.radius, t = std::atan(x / scale);
    const double k = stress_at(bite.strip.flow_stress, in, std::min(h, in.entry_thickness));
    const double p = entry_side ? entry * k * h * std::exp(per_angle * (c.entry_angle - t))
                                : exit * k * h * std::exp(per_angle * (t - c.exit_angle));
    if (k > 0)
      state.largest_shear = std::max(state.largest_shear, 2 * c.friction * p / k);
    state.peak_pressure = std::max(state.peak_pressure, p);
    return p;
  };
  value_at(c.neutral_position, true);
  if (points < 2) {
    value_at(c.exit_position, false);
    value_at(c.entry_position, true);
    return;
  }
  state.position       = curve_positions(c.exit_position, c.neutral_position, c.entry_position, points);
  const Eigen::Index n = state.position.size();
  state.pressure.resize(n);
  state.shear.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const bool entry_side = i >= points;
    state.pressure[i]     = value_at(state.position[i], entry_side);
    state.shear[i]        = i == points - 1 ? 0 : (entry_side ? 1 : -1) * c.friction * state.pressure[i];
  }
  fill_curves(state, in, c.entry_speed);
}

BlandFordContact<double> plain_contact(const BlandFordContact<Number> &c)
{
  BlandFordContact<double> p;
  p.entry_position     = c.entry_position.value;
  p.neutral_position   = c.neutral_position.value;
  p.exit_position      = c.exit_position.value;
  p.entry_angle        = c.entry_angle.value;
  p.neutral_angle      = c.neutral_angle.value;
  p.exit_angle         = c.exit_angle.value;
  p.entry_factor       = c.entry_factor.value;
  p.exit_factor        = c.exit_factor.value;
  p.exit_thickness     = c.exit_thickness.value;
  p.friction           = c.friction.value;
  p.film               = c.film.value;
  p.entry_speed        = c.entry_speed.value;
  p.exit_speed         = c.exit_speed.value;
  p.free_neutral_angle = c.free_neutral_angle;
  p.balance            = c.balance;
  return p;
}
}  // namespace

BiteState solve_bland_ford(const RollBite &bite, const Arc arc, const int curve_points)
{
  check_pass(bite);
  check_coulomb(bite);
  if (arc == Arc::elastic)
    throw InputError("the theory of Bland and Ford is closed on circular arcs only; take the Karman slab for an "
                     "elastic arc");
  const Strip &s           = bite.strip;
  const bool open_at_entry = entry_starts_from_nothing(s);
  if (open_at_entry && s.entry_tension != 0)
    throw InputError(sentence("strip.entry_tension = ", s.entry_tension / 1e6,
                              " MPa: the theory of Bland and Ford divides it by the flow stress at the entry, "
                              "which strip.flow_stress.law = \"",
                              name_of(s.flow_stress.law),
                              "\" leaves open for a strip without strain; take karman, or give "
                              "strip.initial_thickness"));
  const HillRules &rules = hill_rules(bite);
  BiteState state;
  state.model            = arc == Arc::rigid ? "Bland-Ford slab, rigid arc" : "Bland-Ford slab, Hitchcock's arc";
  state.flattened_radius = bite.roll_radius;
  double speed = (std::isnan(bite.roll_speed) ? 1 : bite.roll_speed) * s.exit_thickness / s.entry_thickness;
  if (arc == Arc::hitchcock) {
    const auto flattened   = flattened_arc(bite, [&](const double radius) {
      return bland_ford_state(bite, pass_inputs<double>(bite, radius), speed, rules).force;
    });
    state.flattened_radius = flattened.radius;
    state.iterations       = flattened.evaluations;
  }
  const double R = state.flattened_radius;
  const auto in  = pass_inputs<double>(bite, R);
  const auto d   = bland_ford_state(bite, differentiable_inputs(bite, R), speed, rules);
  require_neutral_point(bite, d.contact, R);

  const BlandFordContact<double> c = plain_contact(d.contact);
  state.force                      = d.force.value;
  state.torque                     = d.torque.value;
  state.friction                   = c.friction;
  state.film_thickness             = c.film;
  state.arc_length                 = c.entry_position;
  state.exit_position              = c.exit_position;
  state.bite_angle                 = c.entry_position / R;
  state.neutral_position           = c.neutral_position;
  state.neutral_thickness          = in.exit_thickness + c.neutral_position * c.neutral_position / R;
  state.forward_slip               = c.exit_speed / in.roll_speed - 1;
  state.entry_flow_stress          = stress_at(s.flow_stress, in, in.entry_thickness);
  state.exit_flow_stress           = stress_at(s.flow_stress, in, c.exit_thickness);
  state.force_by                   = d.force.by;
  state.torque_by                  = d.torque.by;
  forget_unknown_speeds(bite, state);
  if (!std::isnan(bite.roll_speed)) {
    state.entry_speed = c.entry_speed;
    state.exit_speed  = c.exit_speed;
  }
  if (open_at_entry)
    state.force_by[int(Input::entry_tension)] = state.torque_by[int(Input::entry_tension)] = not_given;
  const double F_h = by(state.force_by, Input::exit_thickness), F_R = by(state.force_by, Input::arc_radius);
  state.force_by_exit_following = arc == Arc::rigid ? F_h : following_slope(bite, state.force, F_h, F_R);
  sample(state, bite, in, c, curve_points);
  state.notes = range_notes(bite, state, state.friction);
  return state;
}
}  // namespace mill::bite
