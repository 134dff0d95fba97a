#include "reduce/bite/schedule/force_fit.h"
#include "core/base/errors.h"
#include "reduce/bite/schedule/arc_force.h"
#include "reduce/bite/schedule/rising_root.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/slab_checks.h"
#include <algorithm>
#include <cmath>

namespace mill::bite {
namespace {
constexpr double smallest_friction = 1e-6;  // -, stands for none
constexpr double most_stress       = 1e14;  // Pa, three orders above any solid
constexpr double same_root         = 1e-7;  // of the force: the first root is the one that was asked for

RollBite with_stress(RollBite bite, const double stress)
{
  bite.strip.flow_stress   = {};
  bite.strip.flow_stress.k = stress;
  return bite;
}

RollBite with_friction(RollBite bite, const double friction)
{
  Friction &law = bite.strip.friction;
  law           = slides(law) ? as_number(law, friction) : with_number(law, friction);
  return bite;
}

void require_force(const double force)
{
  if (!(force > 0 && std::isfinite(force)))
    throw InputError(sentence("a force of ", force / 1e3, " kN cannot be fitted; it must be positive"));
}

// The state at the fitted value, whose arc must be the one that the force asked for.
BiteState state_at(const RollBite &bite, const Theory theory, const Arc arc, const double force)
{
  BiteState state = solve_slab(bite, {theory, arc, 0});
  if (std::abs(state.force / force - 1) <= same_root)
    return state;
  throw SolverError(
      {sentence("fit of the rolling force: the roll reaches ", state.force / 1e3, " kN before ", force / 1e3,
                " kN"),
       sentence("R'/R = ", state.flattened_radius / bite.roll_radius, " at the first root of R'(P), ",
                radius_under(bite, arc, force) / bite.roll_radius, " at the force that is asked for"),
       "the force belongs to a second flattened radius, which a mill that loads up does not reach",
       "another friction, or the force of a larger work roll", ""});
}
}  // namespace

ForceFit fit_flow_stress(const RollBite &bite, const Theory theory, const Arc arc, const double force)
{
  require_force(force);
  check_friction(bite);
  const double radius     = radius_under(bite, arc, force);
  const auto force_for    = [&](const double k) { return force_on_arc(with_stress(bite, k), theory, radius); };
  const Strip &s          = bite.strip;
  const double arc_length = std::sqrt(radius * (s.entry_thickness - s.exit_thickness));
  const double pressure   = force / (s.width * arc_length);
  // A strip that yields under its tension alone is the softest that can be rolled.
  const double softest = std::max({s.entry_tension, s.exit_tension, 1e-9 * pressure}) * (1 + 1e-12);
  double high          = std::max(pressure, 2 * softest);
  while (high < most_stress && force_for(high) < force)
    high *= 2;
  const RisingRoot root = rising_root(softest, high, force, force_for);
  if (!root.met)
    throw InputError(sentence("no flow stress returns a force of ", force / 1e3, " kN: a strip of ",
                              root.argument / 1e6, " MPa, ",
                              root.argument > softest ? "the hardest that is tried" : "which its tension draws",
                              ", takes ", root.value / 1e3, " kN"));
  ForceFit fit;
  fit.value = root.argument;
  fit.bite  = with_stress(bite, root.argument);
  fit.state = state_at(fit.bite, theory, arc, force);
  return fit;
}

ForceFit fit_friction(const RollBite &bite, const Theory theory, const Arc arc, const double force,
                      const double most)
{
  require_force(force);
  check_pass(bite);
  const double radius   = radius_under(bite, arc, force);
  const auto force_for  = [&](const double mu) { return force_on_arc(with_friction(bite, mu), theory, radius); };
  const RisingRoot root = rising_root(smallest_friction, most, force, force_for);
  if (!root.met)
    throw InputError(sentence(
        "no friction returns a force of ", force / 1e3, " kN: ",
        root.argument > smallest_friction ? sentence("a friction of ", most) : "the pass without any", " takes ",
        root.value / 1e3, " kN; the flow stress is too ", root.argument > smallest_friction ? "low" : "high"));
  ForceFit fit;
  fit.value = root.argument;
  fit.bite  = with_friction(bite, root.argument);
  fit.state = state_at(fit.bite, theory, arc, force);
  return fit;
}
}  // namespace mill::bite
