#include "reduce/bite/slab/sims.h"
#include "core/base/errors.h"
#include "core/laws/friction_law.h"
#include "core/numerics/derivative.h"
#include "core/numerics/gauss.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/flattening.h"
#include "reduce/bite/slab/karman_arc.h"
#include <cmath>

namespace mill::bite {
namespace {
constexpr double smallest_friction =
    0.25;  // below it the strip slips over most of the arc and the formula means nothing

template <class T> struct Sticking {
  T force, torque, neutral_angle, neutral_thickness, factor;
};

template <class T>
Sticking<T> sticking(const T &radius, const double arm, const T &h1, const T &h2, const T &yield)
{
  using std::atan;
  using std::log;
  using std::sqrt;
  using std::tan;
  const T r = (h1 - h2) / h1, q = sqrt(radius / h2), c = sqrt((1.0 - r) / r), angle = atan(sqrt(r / (1.0 - r)));
  Sticking<T> s;
  s.neutral_angle     = tan(0.5 * (angle + M_PI / 4 * log(1.0 - r) / q)) / q;
  s.neutral_thickness = h2 + radius * s.neutral_angle * s.neutral_angle;
  s.factor = M_PI / 2 * c * angle - M_PI / 4 - c * q * log(s.neutral_thickness / h2) - 0.5 * c * q * log(1.0 - r);
  s.force  = yield * sqrt(radius * (h1 - h2)) * s.factor;
  s.torque = arm * radius * 0.5 * yield * (sqrt((h1 - h2) / radius) - 2.0 * s.neutral_angle);
  return s;
}

template <class T> T stress_at(const RollBite &bite, const T &reference, const T &h)
{
  using std::log;
  return flow_stress(bite.strip.flow_stress, T(log(reference / h)));
}

/// Mean over the arc, in x; the reference of the strain goes with the entry where it is not given.
template <class T> T mean_flow_stress(const RollBite &bite, const T &h1, const T &h2)
{
  static const GaussRule rule = gauss_legendre(24);
  const T reference           = std::isfinite(bite.strip.initial_thickness) ? T(bite.strip.initial_thickness) : h1;
  T sum(0.0);
  for (Eigen::Index i = 0; i < rule.node.size(); ++i) {
    const double x = 0.5 * (1 + rule.node[i]);
    sum += 0.5 * rule.weight[i] * stress_at(bite, reference, T(h2 + (h1 - h2) * (x * x)));
  }
  return sum;
}

void check_sticking(const RollBite &bite)
{
  const Strip &strip       = bite.strip;
  const Friction &friction = strip.friction;
  if (!slides(friction)) {
    if (std::min(friction.entry_factor, friction.exit_factor) < 2 * smallest_friction)
      throw InputError(sentence("Sims' formula takes the strip as sticking; with friction factors of ",
                                friction.entry_factor, " and ", friction.exit_factor,
                                " it slips. Give factors of at least 0.5, or use karman or orowan"));
  } else if (follows_bite(friction)) {
    throw InputError(
        "Sims' formula takes the strip as sticking; under a film it slips. Use karman, orowan or bland_ford");
  } else {
    const double mu = coulomb_coefficient(friction, Inlet<double>{bite.roll_speed, 0, 0, 0, 0, 0});
    if (!(mu >= smallest_friction))
      throw InputError(sentence("Sims' formula takes the strip as sticking; with a friction coefficient of ", mu,
                                " it slips. It is refused below 0.25; use karman or orowan"));
  }
  if (strip.entry_tension != 0 || strip.exit_tension != 0)
    throw InputError(
        sentence("Sims' formula knows no tension, but strip.entry_tension = ", strip.entry_tension / 1e6,
                 " MPa and strip.exit_tension = ", strip.exit_tension / 1e6, " MPa; use karman or orowan"));
}
}  // namespace

SimsForce sims_force(const double radius, const double arm, const double h1, const double h2, const double yield)
{
  if (!(h1 > h2 && h2 > 0))
    throw InputError(sentence("Sims' formula: the exit thickness of ", h2 * 1e3,
                              " mm must be less than that of the entry, ", h1 * 1e3, " mm"));
  const Sticking<double> s = sticking(radius, arm, h1, h2, yield);
  return {s.force, s.torque, s.neutral_angle, s.factor};
}

std::vector<ForceFactor> fitted_force_factors(const double radius, const double h1, const double h2)
{
  const double length = std::sqrt(radius * (h1 - h2));
  return {{"Ford-Alexander", M_PI / 4 + length / (2 * (h1 + h2)), "formula quoted from memory, not looked up"},
          {"Denton-Crane", 0.655 + 0.265 * length / std::sqrt(h1 * h2),
           "formula quoted from memory, not looked up; its coefficients are uncertain"}};
}

BiteState solve_sims(const RollBite &bite, const Arc arc, const int points)
{
  check_slices(bite);
  check_sticking(bite);
  const Strip &strip = bite.strip;
  const double width = strip.width;
  const double mean  = mean_flow_stress(bite, strip.entry_thickness, strip.exit_thickness);
  const auto force   = [&](const double radius) {
    return width * sticking(radius, bite.roll_radius, strip.entry_thickness, strip.exit_thickness, mean).force;
  };
  BiteState state;
  state.flattened_radius = bite.roll_radius;
  if (arc == Arc::hitchcock) {
    const FlattenedArc flat = flattened_arc(bite, force);
    state.flattened_radius  = flat.radius;
    state.iterations        = flat.evaluations;
  }
  const auto entry_of = [](const double value, const Input which) {
    return Slope::variable(value, static_cast<int>(which));
  };
  const Slope h1          = entry_of(strip.entry_thickness, Input::entry_thickness),
              h2          = entry_of(strip.exit_thickness, Input::exit_thickness);
  const Slope yield       = entry_of(1, Input::flow_stress) * mean_flow_stress(bite, h1, h2);
  const Slope radius      = entry_of(state.flattened_radius, Input::arc_radius);
  const Sticking<Slope> s = sticking(radius, bite.roll_radius, h1, h2, yield);
  state.force             = width * s.force.value;
  state.torque            = width * s.torque.value;
  state.force_by.fill(not_given);
  state.torque_by.fill(not_given);
  for (const Input i : {Input::entry_thickness, Input::exit_thickness, Input::flow_stress, Input::arc_radius}) {
    state.force_by[int(i)]  = width * s.force.by[int(i)];
    state.torque_by[int(i)] = width * s.torque.by[int(i)];
  }
  state.force_by_exit_following =
      arc == Arc::hitchcock ? following_slope(bite, state.force, by(state.force_by, Input::exit_thickness),
                                              by(state.force_by, Input::arc_radius))
                            : by(state.force_by, Input::exit_thickness);
  state.friction          = slides(strip.friction)
                                ? coulomb_coefficient(strip.friction, Inlet<double>{bite.roll_speed, 0, 0, 0, 0, 0})
                                : friction_value(strip.friction, 0);
  const double R          = state.flattened_radius;
  state.arc_length        = std::sqrt(R * (strip.entry_thickness - strip.exit_thickness));
  state.bite_angle        = state.arc_length / R;
  state.neutral_position  = R * s.neutral_angle.value;
  state.neutral_thickness = s.neutral_thickness.value;
  state.sticking_length   = state.arc_length;
  state.entry_speed       = bite.roll_speed * s.neutral_thickness.value / strip.entry_thickness;
  state.exit_speed        = bite.roll_speed * s.neutral_thickness.value / strip.exit_thickness;
  state.forward_slip      = s.neutral_thickness.value / strip.exit_thickness - 1;
  const double reference =
      std::isfinite(strip.initial_thickness) ? strip.initial_thickness : strip.entry_thickness;
  state.entry_flow_stress = stress_at(bite, reference, strip.entry_thickness);
  state.exit_flow_stress  = stress_at(bite, reference, strip.exit_thickness);
  state.largest_shear     = 1;
  // The pressure behind the formula: the equation of slices with w = pi/4 and one flow stress.
  RollBite stuck                    = bite;
  stuck.strip.flow_stress           = {};
  stuck.strip.flow_stress.k         = mean;
  stuck.strip.friction              = {};
  stuck.strip.friction.law          = FrictionLaw::factor;
  stuck.strip.friction.entry_factor = stuck.strip.friction.exit_factor = 1;
  KarmanOptions options;
  options.small_angles    = true;
  options.derivatives     = false;
  options.points          = std::max(points, 3);
  const CircularBite hill = solve_on_circle(stuck, Theory::orowan, R, 0, options);
  state.peak_pressure     = hill.peak_pressure;
  if (points > 0) {
    state.position  = hill.position;
    state.thickness = hill.thickness;
    state.pressure  = hill.pressure;
    state.shear     = hill.shear;
    state.slip      = hill.slip;
  }
  if (hardens(strip.flow_stress))
    state.notes.push_back({WarningId::bite_stress_mean, "", "Sims' formula takes one flow stress",
                           "given is its mean over the arc"});
  return state;
}
}  // namespace mill::bite
