#include "app/verbs/stack_command.h"
#include "app/command/option_words.h"
#include "app/process/console.h"
#include "app/stack/stack_bearings.h"
#include "app/stack/stack_bite.h"
#include "app/stack/stack_optimise.h"
#include "app/verbs/driven_case.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/model/case.h"
#include <fmt/format.h>

namespace mill {
namespace {
// "NAME=TEXT"
std::pair<std::string, std::string> named(const std::string &text, const std::string &option)
{
  const auto equals = text.find('=');
  if (equals == std::string::npos)
    throw InputError(option + " \"" + text + "\" has no '='");
  return {text.substr(0, equals), text.substr(equals + 1)};
}

double quantity_of(const std::string &text, const char *wanted_unit, const std::string &option)
{
  const ParsedQuantity parsed = parse_quantity(text);
  if (parsed.fault != ParsedQuantity::Fault::none || !(parsed.unit->dimension == unit(wanted_unit).dimension))
    throw InputError(
        fmt::format("{}: \"{}\" is not {}, as \"20 {}\"", option, text, unit(wanted_unit).quantity, wanted_unit));
  return parsed.value();
}

const char *unit_of(const StackActuator &actuator)
{
  return actuator.kind == StackActuatorKind::bending ? "kN"
         : actuator.kind == StackActuatorKind::shift ? "mm"
                                                     : "um";
}

std::vector<StackTarget> targets_of(const StackOptions &options)
{
  std::vector<StackTarget> targets;
  for (const std::string &text : options.targets) {
    const auto [name, value] = named(text, "--target");
    const auto goal          = choice_named<StackGoal>(name);
    if (!goal)
      throw InputError("--target " + name + " is unknown; crown, edge_drop and wedge are targets");
    targets.push_back({*goal, quantity_of(value, "um", "--target " + name)});
  }
  return targets;
}

std::vector<StackActuator> actuators_of(const StackOptions &options, const StackInput &input, const Stack &stack)
{
  std::vector<StackActuator> actuators;
  for (const std::string &text : options.bounds) {
    const auto [name, range] = named(text, "--bound");
    const auto dots          = range.find("..");
    if (dots == std::string::npos)
      throw InputError("--bound \"" + text + "\" has no range LOW..HIGH");
    StackActuator actuator   = stack_actuator(input, stack, name);
    const std::string option = "--bound " + name;
    actuator.low             = quantity_of(range.substr(0, dots), unit_of(actuator), option);
    actuator.high            = quantity_of(range.substr(dots + 2), unit_of(actuator), option);
    if (!(actuator.low < actuator.high))
      throw InputError(option + ": the lower bound is not below the upper one");
    actuators.push_back(std::move(actuator));
  }
  return actuators;
}

std::string text_of(const StackOptimum &optimum)
{
  std::string text = fmt::format("{:<24} {:>14} {:>14} {:>14}\n", "strip", "now", "wanted", "reached");
  for (const StackTarget &t : optimum.targets)
    text += fmt::format("{:<24} {:>11.5g} um {:>11.5g} um {:>11.5g} um\n", word_of(t.goal), 1e6 * t.present,
                        1e6 * t.wanted, 1e6 * t.reached);
  const std::string first = word_of(optimum.targets.front().goal);
  text += fmt::format("\n{:<24} {:>14} {:>14} {:>8}   what is left of its range would change the {} by\n",
                      "actuator", "now", "optimum", "bound", first);
  for (const StackActuator &a : optimum.actuators) {
    const Unit &shown = unit(unit_of(a));
    const double down = 1e6 * a.influence[0] * (a.low - a.optimum) + 0.,
                 up   = 1e6 * a.influence[0] * (a.high - a.optimum) + 0.;
    text += fmt::format("{:<24} {:>11.5g} {:<2} {:>11.5g} {:<2} {:>8}   {:+.4g} um down, {:+.4g} um up\n", a.name,
                        from_si(a.present, shown), shown.symbol, from_si(a.optimum, shown), shown.symbol,
                        a.bound.empty() ? "-" : a.bound, down, up);
  }
  return text + fmt::format("\n{} solutions of the stack\n", optimum.steps);
}
}  // namespace

int stack_command(const CommandLine &command, const Case &the_case)
{
  const StackOptions &options = command.stack;
  if (!choice_named<StackAction>(options.action))
    throw InputError("millstand stack knows one action, optimise, not \"" + options.action + "\"");
  const auto *spec = std::get_if<StackCase>(&the_case.spec);
  if (!spec)
    throw InputError("millstand stack takes a case of kind \"stack\"; " + the_case.path + " is of kind \"" +
                     the_case.kind + "\"");
  const auto targets   = targets_of(options);
  const auto actuators = actuators_of(options, *spec->input, *spec->stack);
  StackOptimum optimum;
  run_in_scratch(command, the_case, {{"stack", 1}}, [&](RunContext &run) {
    const Stack held  = with_bearing_curves(*spec->stack, solve_stack_bearings(run, *spec->input, *spec->stack));
    const Stack stack = with_slopes_of_bite(*spec->input, held);
    optimum = optimise_stack(*spec->input, stack, leading_engine(run, *spec->input, stack), actuators, targets);
  });
  console::print(text_of(optimum));
  return 0;
}
}  // namespace mill
