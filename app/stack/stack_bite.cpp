#include "app/stack/stack_bite.h"
#include "app/stages/bite/bite_stage.h"
#include "reduce/bite/linear/linear_coefficients.h"
#include "reduce/bite/schedule/force_fit.h"
#include "reduce/bite/slab/slab_bite.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
StackBite stack_bite(const StackInput &input, const Stack &stack, const Pass &pass, const double force)
{
  const StackRoll &roll = stack.rolls[stack.upper];
  StackBite made;
  made.bite = bite_of(input.bite, pass, roll.diameter, roll.material);
  if (std::isnan(made.bite.strip.flow_stress.k)) {
    made.bite.strip.flow_stress.k = 0;
    const auto fit =
        bite::fit_flow_stress(made.bite, bite::closed_form_theory(made.bite.strip), bite::Arc::hitchcock, force);
    made.bite   = fit.bite;
    made.stress = fmt::format("{:.4g} MPa, fitted to the rolling force", 1e-6 * fit.value);
  } else
    made.stress = "strip.flow_stress";
  return made;
}

std::string missing_of_bite(const StackInput &input, const std::size_t p)
{
  const Pass &pass = input.passes[p];
  std::string missing;
  const auto add = [&](const bool lacks, const std::string &key) {
    if (lacks)
      missing += (missing.empty() ? "" : ", ") + key;
  };
  add(std::isnan(input.strip.entry_thickness) && std::isnan(pass.entry_thickness), "strip.entry_thickness");
  add(std::isnan(input.strip.exit_thickness) && std::isnan(pass.exit_thickness), "strip.exit_thickness");
  add(!bite::has_friction(input.bite.friction), "strip.friction");
  add(needs_speed(input.bite.friction) && std::isnan(pass.speed), fmt::format("pass.{}.speed", p));
  return missing;
}

Stack with_slopes_of_bite(const StackInput &input, const Stack &stack, const Pass &pass)
{
  if (input.strip.law != StackStripLaw::bite)
    return stack;
  Pass as_given = pass;
  if (needs_speed(input.bite.friction) && std::isnan(as_given.speed) && !input.passes.empty())
    as_given.speed = input.passes.front().speed;
  StackBite rolled = stack_bite(input, stack, as_given, stack.strip.force);
  if (!(rolled.bite.roll_speed > 0))
    rolled.bite.roll_speed = 1;  // m/s: friction does not follow it
  const auto state = bite::solve_slab(rolled.bite, {bite::Theory::bland_ford, bite::Arc::hitchcock, 0});
  const auto by    = bite::linear_coefficients(rolled.bite, state, Linearisation::implicit);
  enum { exit_thickness, gap_rate, entry_tension, exit_tension, entry_thickness };
  Stack sloped          = stack;
  StackStrip &strip     = sloped.strip;
  strip.entry_thickness = rolled.bite.strip.entry_thickness;
  strip.exit_thickness  = rolled.bite.strip.exit_thickness;
  strip.modulus         = -by.force[exit_thickness] / strip.width;
  strip.entry_modulus   = by.force[entry_thickness] / strip.width;
  strip.tension_modulus =
      std::abs(by.force[exit_tension]) / strip.width * input.bite.youngs_modulus / strip.exit_thickness;
  if (std::isnan(input.strip.arc))
    strip.arc = state.arc_length;
  return sloped;
}
}  // namespace mill
