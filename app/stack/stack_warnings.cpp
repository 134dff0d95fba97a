#include "app/stack/stack_warnings.h"
#include "app/stack/stack_curves.h"
#include "core/model/stack_input.h"
#include "core/records/rows_of_stack.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// A profile deeper than the thickness: no strip has it, and no flatness follows from it.
void warn_of_closed_gap(RunContext &run, const SolvedStack &solved)
{
  const reduce::StripState &strip = solved.state.strip;
  Eigen::Index thinnest           = 0;
  const double thickness          = strip.opening.minCoeff(&thinnest) + unloaded_gap(solved);
  if (!(thickness <= 0))  // without an exit thickness it is NaN
    return;
  const double z = (strip.edges[thinnest] + strip.edges[thinnest + 1]) / 2;
  run.warn(
      {WarningId::value_doubtful,
       "strip",
       fmt::format("the loaded gap closes {:.4g} mm from the middle of the strip: its thickness there would be "
                   "{:.4g} um",
                   1e3 * std::abs(z), 1e6 * thickness),
       "the strip cannot have this profile, and has no flatness",
       "give strip.tension_modulus: fibres that get longer lose tension and need more force",
       {row::stack::crown.of().text()}});
}
}  // namespace

void note_missing_tangents(RunContext &run, const StackNumbers &numbers)
{
  for (const StackNumber &number : numbers)
    if (&number.name.row() == &row::pair::tangent && std::isnan(number.value))
      run.progress.note(number.name.text() +
                        " is left out: more rolling force loads the places of the contact so unevenly that the "
                        "approach which the load weighs does not follow the force");
}

void warn_of_state(RunContext &run, const SolvedStack &solved)
{
  const Stack &stack = solved.stack;
  for (std::size_t c = 0; c < stack.contacts.size(); ++c) {
    const StackContact &contact = stack.contacts[c];
    const auto &pair            = solved.state.pairs[c];
    if (pair.touching < 1 - 1e-9)
      run.warn({WarningId::contact_partly_open, "",
                fmt::format("contact {} is open on {:.0f} % of its length", pair_name(stack, contact),
                            100 * (1 - pair.touching))});
    for (const std::size_t r : {contact.a, contact.b})
      if (const double yield = stack.rolls[r].material.yield_stress; pair.peak_pressure > 5 * yield)
        run.warn({WarningId::contact_yield, "contact " + pair_name(stack, contact),
                  fmt::format("the peak pressure of {:.0f} MPa is above five times the yield stress of roll {}",
                              1e-6 * pair.peak_pressure, stack.rolls[r].name)});
  }
  warn_of_closed_gap(run, solved);
  for (const std::size_t r : {stack.upper, stack.lower}) {
    const StackRoll &roll = stack.rolls[r];
    const double beyond   = roll.length / 2 - std::abs(stack.strip.offset - roll.shift) - stack.strip.width / 2;
    const double to_end   = std::abs(beyond) < 1e-6 ? 0 : beyond;  // rounding of drawings
    if (to_end < 2 * stack.strip.arc)
      run.warn({WarningId::strip_at_barrel_end, "",
                fmt::format("the edge of the strip is {:.4g} mm from the end of the barrel of roll {}, less than "
                            "twice the length of contact",
                            1e3 * to_end, roll.name),
                "its flattening there is larger than that of the half space"});
  }
}

void say_what_is_assumed_of(RunContext &run, const StackInput &input)
{
  for (const StackRollInput &roll : input.rolls)
    if (roll.on.empty() && !roll.saddles.given && roll.bearing_stiffness.empty() && roll.bearing.empty())
      run.assume(fmt::format("the bearings and the housing of roll {} are rigid, since neither bearing_stiffness "
                             "nor bearing is given",
                             roll.name));
  run.assume(
      "the strip does not flow across the width: its flatness is the difference of elongations that nothing "
      "evens out");
}
}  // namespace mill
