#include "twin/advice/process_action.h"
#include "twin/advice/critical_state.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
using bite::PassNumber;

std::string percent(const double part)
{
  return fmt::format("{:.3g} %", 100 * part);
}
}  // namespace

std::vector<ProcessAction> process_actions(const bite::RollBite &bite, const ProcessAdvice &bounds)
{
  std::vector<ProcessAction> actions;
  const auto known = bite::numbers_of(bite);
  const auto add   = [&](const char *name, const char *means, const int number,
                       const std::array<double, 2> &factors) {
    if (number >= 0 && std::count(known.begin(), known.end(), PassNumber(number)) == 0)
      return;  // no tension, no oil
    for (const double factor : factors)
      if (factor != 1)
        actions.push_back({fmt::format("{} x {:g}", name, factor), name, means,
                           number < 0 ? "" : bite::name_of(PassNumber(number)).key, factor, number});
  };
  add("speed", "set point of the mill", -1, bounds.speed);
  add("entry thickness", "exit thickness of the stand before, whose reduction changes instead",
      int(PassNumber::entry_thickness), bounds.entry_thickness);
  add("entry tension", "tension set point between this stand and the one before", int(PassNumber::entry_tension),
      bounds.entry_tension);
  add("exit tension", "tension set point between this stand and the next one", int(PassNumber::exit_tension),
      bounds.exit_tension);
  add("oil viscosity", "other oil, its temperature, concentration of the emulsion", int(PassNumber::viscosity),
      bounds.viscosity);
  add("flow stress", "another grade, coiling temperature or annealing: it belongs to the product",
      int(PassNumber::stress_factor), bounds.flow_stress);
  for (const PassNumber number : {PassNumber::friction, PassNumber::friction_scale})
    if (!has_film(bite.strip.friction))
      add("friction", "other lubrication, roughness of the rolls", int(number), bounds.friction);
  return actions;
}

ChangedPass changed_pass(const bite::RollBite &bite, const std::vector<ProcessAction> &actions)
{
  ChangedPass pass{bite, 1};
  for (const ProcessAction &action : actions)
    if (action.number < 0)
      pass.speed_factor *= action.factor;
    else
      pass.bite = with_number_scaled(pass.bite, PassNumber(action.number), action.factor);
  return pass;
}

Violations violations(const ChangedPass &pass, const CriticalState &now, const CriticalState &after,
                      const double working_speed, const ProcessAdvice &limits)
{
  Violations v;
  if (const double initial = pass.bite.strip.initial_thickness; pass.bite.strip.entry_thickness > initial) {
    v.against.push_back("the strip would be thicker than before all rolling");
    v.kept_apart = true;
  }
  if (after.no_bite) {
    v.against.push_back("no steady bite at the working speed: " + after.why);
    v.kept_apart = true;
    return v;
  }
  const double wanted = std::isnan(limits.wanted_speed) ? working_speed : limits.wanted_speed;
  if (const double speed = working_speed * pass.speed_factor; speed < wanted * (1 - 1e-12)) {
    v.against.push_back(fmt::format("rolls at {:.4g} m/s, at least {:.4g} m/s are wanted", speed, wanted));
    v.kept_apart = true;
  }
  if (const double rise = after.force / now.force - 1; rise > limits.force_rise)
    v.against.push_back(
        fmt::format("the force rises by {}, at most {} are allowed", percent(rise), percent(limits.force_rise)));
  if (const double rise = after.torque / now.torque - 1; rise > limits.torque_rise)  // NaN: any
    v.against.push_back(
        fmt::format("the torque rises by {}, at most {} are allowed", percent(rise), percent(limits.torque_rise)));
  return v;
}
}  // namespace mill::twin
