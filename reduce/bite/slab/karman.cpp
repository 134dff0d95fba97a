#include "reduce/bite/slab/karman.h"
#include "core/base/errors.h"
#include "core/laws/friction_law.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/elastic_arc.h"
#include "reduce/bite/slab/flattening.h"
#include "reduce/bite/slab/karman_arc.h"
#include "reduce/bite/slab/sims.h"
#include "reduce/bite/slab/slab_checks.h"
#include <algorithm>
#include <cmath>

namespace mill::bite {
namespace {
constexpr int by_friction = static_cast<int>(Input::friction);
constexpr int by_speed    = static_cast<int>(Input::roll_speed);
using Wide                = Dual<n_inputs>;

/// The same derivatives by more inputs: zero by speed and gap rate.
Wide widened(const Slope &x)
{
  Wide y(x.value);
  std::copy(x.by.begin(), x.by.end(), y.by.begin());
  return y;
}

/// What the friction law sees of a solved bite.
Inlet<Wide> inlet_of(const RollBite &bite, const CircularBite &s, const double radius)
{
  const auto input = [](const double value, const Input which) {
    return Wide::variable(value, static_cast<int>(which));
  };
  Inlet<Wide> in;
  in.roll_speed     = input(bite.roll_speed, Input::roll_speed);
  const Wide flux   = in.roll_speed * widened(s.neutral_cosine * s.neutral_thickness);  // per width
  in.entry_speed    = flux / input(bite.strip.entry_thickness, Input::entry_thickness);
  in.exit_speed     = flux / input(bite.strip.exit_thickness, Input::exit_thickness);
  in.radius         = input(radius, Input::arc_radius);
  in.arc_length     = widened(s.arc_length);
  in.entry_pressure = widened(s.entry_flow_stress) - input(bite.strip.entry_tension, Input::entry_tension);
  return in;
}

/// Steps of the integration for one flattened state; cold passes take some hundreds.
constexpr int most_steps = 40000;

[[noreturn]] void refuse_slow_flattening(const RollBite &bite, const double radius, const int steps)
{
  throw SolverError(
      {"roll bite: the flattened radius is not found",
       sentence("R'/R = ", radius / bite.roll_radius, " and still moving after ", steps, " steps along the arc"),
       "a strip that is far too thin or too hard for this roll",
       "a smaller work roll, less friction, more tension, or a thicker strip.exit_thickness", ""});
}

/// A bite on a circle with the friction that belongs to it.
struct Lubricated {
  CircularBite bite;
  double mu = 0;
};

/// Film friction depends on the speeds and these on the neutral point: secants in mu.  (17.7)
Lubricated lubricated(const RollBite &bite, const Theory theory, const double radius, const Lubricated &start,
                      const KarmanOptions &options)
{
  const Friction &law = bite.strip.friction;
  if (!follows_bite(law)) {
    const double mu = slides(law) ? coulomb_coefficient(law, Inlet<double>{bite.roll_speed, 0, 0, 0, 0, 0}) : 0;
    return {solve_on_circle(bite, theory, radius, mu, options, start.bite.neutral_share), mu};
  }
  KarmanOptions quick = options;
  quick.derivatives   = false;
  quick.points        = 0;
  double share        = start.bite.neutral_share;
  const auto answer   = [&](const double mu) {
    const CircularBite s = solve_on_circle(bite, theory, radius, mu, quick, share);
    share                = s.neutral_share;
    return coulomb_coefficient(law, inlet_of(bite, s, radius)).value;
  };
  double a = start.mu, at_a = answer(a) - a, b = a + at_a;
  for (int i = 0; i < 60; ++i) {
    if (std::abs(b - a) <= 1e-2 * options.tolerance * std::abs(b) || at_a == 0)
      return {solve_on_circle(bite, theory, radius, b, options, share), b};
    const double at_b = answer(b) - b;
    double next       = at_b == at_a ? b + at_b : b - at_b * (b - a) / (at_b - at_a);
    if (!(next > 0) || !(std::abs(next - b) < 0.5 * b))
      next = b + 0.5 * at_b;
    a    = b;
    at_a = at_b;
    b    = next;
  }
  throw SolverError({"roll bite: film and friction do not settle",
                     sentence("mu = ", b, " after 60 steps on an arc of radius ", radius * 1e3, " mm"),
                     "a film that breaks down with the speed of the strip", "another roll speed or film law", ""});
}

/// Derivatives with the friction following its law: dmu = (d law + d mu given) / (1 - d law/d mu).
void follow_friction_law(const Wide &law, Wide &x)
{
  const double by_mu = x.by[by_friction], feedback = 1 - law.by[by_friction];
  for (int i = 0; i < n_inputs; ++i)
    if (i == by_friction)
      x.by[i] = by_mu / feedback;
    else
      x.by[i] += by_mu * law.by[i] / feedback;
}

void add_notes(const RollBite &bite, BiteState &state, const Arc arc)
{
  const Strip &strip = bite.strip;
  const bool factor  = !slides(strip.friction);
  if (!factor && state.bite_angle > state.friction)
    state.notes.push_back(large_angle(state, state.friction));
  if (!factor && !std::isfinite(strip.friction.shear_limit) && state.largest_shear > 1)
    state.notes.push_back(sticking_strip(state, "but no limit is set"));
  else if (!factor && state.sticking_length > 0)
    state.remarks.push_back(sentence("the friction stress is at its limit over ", state.sticking_length * 1e3,
                                     " mm of an arc of ", (state.arc_length - state.exit_position) * 1e3, " mm"));
  if (arc == Arc::hitchcock && beyond_hitchcock(bite, state.flattened_radius))
    state.notes.push_back(beyond_hitchcock_note(bite, state.flattened_radius));
  if (strip.exit_thickness < 0.1e-3)
    state.notes.push_back({WarningId::bite_foil, "",
                           sentence("exit thickness ", strip.exit_thickness * 1e3, " mm"),
                           "below about 0.1 mm a zone without slip forms, in which mu p is not the friction; the "
                           "force is a guide only"});
}

void fill_derivatives(const Wide &force, const Wide &torque, const RollBite &bite, BiteState &state)
{
  const double width = bite.strip.width;
  for (int i = 0; i < n_inputs; ++i) {
    state.force_by[i]  = width * force.by[i];
    state.torque_by[i] = width * torque.by[i];
  }
  const int gap_rate        = static_cast<int>(Input::gap_rate);
  state.force_by[gap_rate]  = not_given;  // the integrated theories know a resting gap only
  state.torque_by[gap_rate] = not_given;
  if (!std::isfinite(bite.roll_speed))
    state.force_by[by_speed] = state.torque_by[by_speed] = not_given;
}
}  // namespace

BiteState solve_karman(const RollBite &bite, const Theory theory, const Arc arc, const ArcFlexibility *flexibility)
{
  return solve_karman(bite, theory, arc, flexibility, KarmanOptions{});
}

BiteState solve_karman(const RollBite &bite, const Theory theory, const Arc arc, const ArcFlexibility *flexibility,
                       const KarmanOptions &options)
{
  if (theory != Theory::karman && theory != Theory::orowan && theory != Theory::sims)
    throw InputError("the integrated slab theories are karman, orowan and sims");
  if (arc == Arc::elastic && theory != Theory::karman)
    throw InputError(
        "the elastic arc is known to the theory karman only: the pressure along an arc that is not a circle is "
        "integrated with it");
  if (needs_speed(bite.strip.friction) && !(bite.roll_speed > 0))
    throw InputError("strip.friction.law = \"" + name_of(bite.strip.friction.law) +
                     "\" needs the speed of the rolls");
  BiteState state;
  if (theory == Theory::sims)
    state = solve_sims(bite, arc, options.points);
  else if (arc == Arc::elastic) {
    state = solve_elastic_arc(bite, flexibility, options);
  } else {
    check_slices(bite);
    const Strip &strip  = bite.strip;
    KarmanOptions quick = options;
    quick.derivatives   = false;
    quick.points        = 0;
    Lubricated last;  // start of the iterations
    last.mu       = 0.05;
    double radius = bite.roll_radius;
    if (arc == Arc::hitchcock) {
      int steps               = 0;
      const FlattenedArc flat = flattened_arc(bite, [&](const double r) {
        last = lubricated(bite, theory, r, last, quick);
        steps += last.bite.steps;
        if (steps > most_steps)
          refuse_slow_flattening(bite, r, steps);
        return strip.width * last.bite.force.value;
      });
      radius                  = flat.radius;
      state.iterations        = flat.evaluations;
    }
    const Lubricated solved = lubricated(bite, theory, radius, last, options);
    const CircularBite &s   = solved.bite;
    if (s.skids)
      refuse_skidding(bite, theory, radius, solved.mu, options);
    if (s.least_pressure < 0)
      throw InputError(
          sentence("strip.entry_tension = ", strip.entry_tension / 1e6,
                   " MPa and strip.exit_tension = ", strip.exit_tension / 1e6,
                   " MPa draw the strip thinner than the rolls do: the pressure between them would fall "
                   "to ",
                   s.least_pressure / 1e6,
                   " MPa; less tension, more friction or a smaller reduction is "
                   "needed"));
    Wide force = widened(s.force), torque = widened(s.torque);
    if (needs_speed(strip.friction)) {
      const Inlet<Wide> inlet = inlet_of(bite, s, radius);
      const auto law          = coefficient_at(strip.friction, inlet);
      state.film_thickness    = law.film.value;
      follow_friction_law(law.mu, force);
      follow_friction_law(law.mu, torque);
    }
    state.force             = strip.width * s.force.value;
    state.torque            = strip.width * s.torque.value;
    state.friction          = friction_value(strip.friction, solved.mu);
    state.flattened_radius  = radius;
    state.arc_length        = s.arc_length.value;
    state.bite_angle        = s.arc_length.value / radius;
    state.neutral_position  = s.neutral_position;
    state.neutral_thickness = s.neutral_thickness.value;
    state.sticking_length   = s.sticking_length;
    const double flux       = s.neutral_thickness.value * s.neutral_cosine.value;
    state.entry_speed       = bite.roll_speed * flux / strip.entry_thickness;
    state.exit_speed        = bite.roll_speed * flux / strip.exit_thickness;
    state.forward_slip      = flux / strip.exit_thickness - 1;
    state.peak_pressure     = s.peak_pressure;
    state.entry_flow_stress = s.entry_flow_stress.value;
    state.exit_flow_stress  = s.exit_flow_stress.value;
    state.largest_shear     = s.largest_shear;
    if (options.derivatives) {
      fill_derivatives(force, torque, bite, state);
      const double by_exit = by(state.force_by, Input::exit_thickness);
      state.force_by_exit_following =
          arc == Arc::hitchcock
              ? following_slope(bite, state.force, by_exit, by(state.force_by, Input::arc_radius))
              : by_exit;
    } else {
      state.force_by.fill(not_given);
      state.torque_by.fill(not_given);
    }
    state.position  = s.position;
    state.thickness = s.thickness;
    state.pressure  = s.pressure;
    state.shear     = s.shear;
    state.slip      = s.slip;
  }
  state.model = model_name({theory, arc});
  add_notes(bite, state, arc);
  return state;
}
}  // namespace mill::bite
