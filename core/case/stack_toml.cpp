#include "core/case/stack_toml.h"
#include "core/case/lumped_model_toml.h"
#include "core/case/row_lines.h"
#include "core/case/stack_rows.h"
#include <cmath>

namespace mill {
namespace {
std::string section(const std::string &header, const std::string &lines)
{
  return lines.empty() ? "" : "\n" + header + "\n" + lines;
}

// The laws of its bite, as far as the case has them.
std::string laws_of(const Strip &strip)
{
  std::string text;
  if (!std::isnan(strip.flow_stress.k)) {
    FlowStressInput flow;
    static_cast<FlowStress &>(flow) = strip.flow_stress;
    flow.name                       = name_of(flow.law);
    text += section("[strip.flow_stress]", lines(flow_stress_rows(), flow));
  }
  if (strip.friction.law != FrictionLaw::coulomb) {
    FrictionInput friction;
    static_cast<Friction &>(friction) = strip.friction;
    friction.name                     = name_of(friction.law);
    text += section("[strip.friction]", lines(friction_rows(), friction));
  }
  return text;
}
}  // namespace

std::string stack_toml(const std::string &title, const StackInput &input, const std::string &directory)
{
  std::string text = lines(head_rows(), CaseHead{1, "stack", title});
  text += section("[steel]", lines(steel_rows(), input.steel));
  for (const StackMaterial &material : input.materials)
    text += section("[material." + material.name + "]", lines(stack_material_rows(), material));
  text += section("[stack]", lines(stack_settings_rows(), input.settings));
  for (const StackRollInput &roll : input.rolls) {
    text += section("[[roll]]", lines(stack_roll_rows(), roll));
    if (roll.saddles.given)
      text += section("[roll.saddles]", lines(stack_saddle_rows(), roll.saddles));
  }
  text += section("[strip]", lines(stack_strip_rows(), input.strip));
  text += laws_of(input.bite);
  text += section("[engine]", lines(stack_engine_rows(), input.engine));
  text += section("[window]", lines(stack_window_rows(), input.window));
  text += section("[dynamics]", lines(stack_dynamics_rows(), input.dynamics));
  text += section("[stand]", lines(stand_span_rows(), input.span));
  text += section("[analysis]", lines(chatter_analysis_rows(), input.analysis));
  for (const Pass &pass : input.passes)
    text += pass_toml(pass, directory);
  return text;
}
}  // namespace mill
