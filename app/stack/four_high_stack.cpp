#include "app/stack/four_high_stack.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/trace/closed_form_chain.h"
#include "core/case/stack_toml.h"
#include "core/model/case.h"
#include "core/model/stack_input.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace mill {
namespace {
double chain_spring(const std::vector<ClosedFormResult> &results, const char *name)
{
  const ClosedFormResult *result = find(results, name);
  if (!result || !(result->parameter.value > 0))
    throw InputError(fmt::format("--as stack needs {} of the stand, and no closed form gives it{}", name,
                                 result ? ": " + result->parameter.method : std::string()));
  return result->parameter.value;
}

// From the middle of the bearings to the ground, one side: the spring of the frame and that to the roll in series,
// without the bending of the roll, which is its own beam here.
double bearing_side(const std::vector<ClosedFormResult> &results, const char *frame, const char *to_roll)
{
  const double flexibility =
      1 / chain_spring(results, frame) + 1 / chain_spring(results, to_roll) - 1 / chain_spring(results, "K_ZW");
  if (!(flexibility > 0))
    throw InputError(
        fmt::format("--as stack: {} is stiffer than the bending of the backup roll in it (K_ZW); give "
                    "K_ZW in [given] as well",
                    to_roll));
  return 0.5 / flexibility;
}

StackRollInput rolled(const char *name, const Roll &drawn)
{
  StackRollInput roll;
  static_cast<Roll &>(roll) = drawn;
  roll.name                 = name;
  roll.total_length         = drawn.barrel_length + 2 * drawn.neck_length;
  roll.bearing.clear();  // its spring is in bearing_stiffness
  roll.chock_mass = {drawn.chock_mass_upper + drawn.bearing_mass, drawn.chock_mass_lower + drawn.bearing_mass};
  return roll;
}

// Line load over exit thickness: the plastic slope of the bite, else a given K4, over the width.
double strip_modulus(const FourHigh &stand, const std::vector<ClosedFormResult> &results)
{
  if (const auto given = stand.given.find("K4"); given != stand.given.end())
    return given->second.parameter.value / stand.strip.width;
  if (const auto bite = closed_form_bite_stiffness(stand, 0))
    return bite->plastic_slope / stand.strip.width;
  return chain_spring(results, "K4") / stand.strip.width;
}

StackStripInput strip_of(const FourHigh &stand, const std::vector<ClosedFormResult> &results, const Pass &pass)
{
  StackStripInput strip;
  const auto of_pass      = [](const double of, const double usual) { return std::isnan(of) ? usual : of; };
  strip.width             = stand.strip.width;
  strip.entry_thickness   = of_pass(pass.entry_thickness, stand.strip.entry_thickness);
  strip.exit_thickness    = of_pass(pass.exit_thickness, stand.strip.exit_thickness);
  strip.entry_tension     = of_pass(pass.entry_tension, stand.strip.entry_tension);
  strip.exit_tension      = of_pass(pass.exit_tension, stand.strip.exit_tension);
  strip.initial_thickness = stand.strip.initial_thickness;
  strip.youngs_modulus    = stand.strip.youngs_modulus;
  strip.poisson_ratio     = stand.strip.poisson_ratio;
  if (stand.strip.friction.law == FrictionLaw::coulomb && stand.strip.friction.coefficient > 0)
    strip.coulomb = stand.strip.friction.coefficient;
  strip.modulus     = strip_modulus(stand, results);
  strip.given_force = working_load(pass, has_force(pass) ? force_of(pass) : ForceRecord{});
  return strip;
}
}  // namespace

std::string four_high_as_stack(const Case &four_high)
{
  const auto *drawn = std::get_if<FourHigh>(&four_high.spec);
  if (!drawn)
    throw InputError("--as stack takes a case of kind \"four-high\"; " + four_high.path + " is of kind \"" +
                     four_high.kind + "\"");
  ClosedFormMemory memory;
  memory.with_responses = false;
  memory.with_inputs    = false;
  const auto results    = closed_form_four_high(*drawn, memory, {});
  const FourHigh &stand = memory.stands.empty() ? *drawn : *memory.stands.front().stand;
  StackInput input;
  input.steel                  = stand.steel;
  StackRollInput work          = rolled("W", stand.work_roll);
  work.on                      = {"B"};
  StackRollInput backup        = rolled("B", stand.backup_roll);
  backup.bearing_stiffness     = {bearing_side(results, "K1", "K2"), bearing_side(results, "K7", "K6")};
  input.rolls                  = {work, backup};
  input.strip                  = strip_of(stand, results, stand.passes.front());
  input.bite                   = stand.strip;
  input.passes                 = stand.passes;
  input.dynamics               = stand.dynamics;
  input.dynamics.force_meaning = stand.dynamics.force_meaning == ForceMeaning::published
                                     ? ForceMeaning::disturbance
                                     : stand.dynamics.force_meaning;
  input.span                   = stand.span;
  input.analysis               = stand.analysis;
  const std::string folder     = std::filesystem::path(four_high.path).parent_path().string();
  return stack_toml(four_high.title + ", as a stack", input, folder);
}
}  // namespace mill
