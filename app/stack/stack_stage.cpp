#include "app/stack/stack_stage.h"
#include "app/run/curve_files.h"
#include "core/model/case.h"
#include "core/numerics/mesh_pair.h"
#include "core/records/stack_names.h"
#include "reduce/stack/line_law.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr int elements_over_width = 60;  // errors of the reference cases: docs/theory/51, "Measured"

reduce::BeamStackSettings settings_of(const StackInput &input, const int elements_per_width)
{
  reduce::BeamStackSettings settings;
  settings.elements_per_width = elements_per_width;
  settings.flattening =
      input.engine.flattening == "local" ? reduce::Flattening::local : reduce::Flattening::half_space;
  return settings;
}

double mean_opening(const reduce::StripState &strip)
{
  const Eigen::VectorXd length =
      strip.edges.tail(strip.edges.size() - 1) - strip.edges.head(strip.edges.size() - 1);
  return strip.opening.dot(length) / length.sum();
}

// The mean of the exit thickness is S plus the mean opening, which grows with the force.
SolvedStack solve_for_gap(const StackInput &input, Stack stack, const int elements_per_width)
{
  const double wanted      = input.strip.exit_thickness - input.strip.gap;
  constexpr int most_steps = 20;
  stack.strip.force        = 1e3 * stack.strip.width * 1e3;  // N, 1 kN per mm of width to begin with
  for (int step = 0; step < most_steps; ++step) {
    reduce::BeamStack engine(stack, settings_of(input, elements_per_width));
    reduce::StackState state = engine.solve();
    const double missing     = wanted - mean_opening(state.strip);
    if (std::abs(missing) < 1e-9 * wanted)
      return {stack, std::move(engine), std::move(state)};
    // Contacts are softer under less load: no step goes below a tenth of the force.
    stack.strip.force = std::max(0.1 * stack.strip.force, stack.strip.force + state.modulus.mean * missing);
  }
  throw SolverError({fmt::format("the rolling force at a gap of {:.6g} mm was not found within {} steps",
                                 1e3 * input.strip.gap, most_steps),
                     fmt::format("{:.5g} kN at the last step", 1e-3 * stack.strip.force),
                     "the gap is far from what the stack can reach with this exit thickness",
                     "give strip.force, and compare stack.gap of that run with strip.gap", ""});
}

void add_results(RunContext &run, const StackNumbers &fine, const StackNumbers &coarse, const double force)
{
  const std::vector<std::string> inputs = keys_of_stack(run.the_case);
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const StackNumber &number = fine[i];
    Parameter p;
    p.value  = number.value;
    p.unit   = number.unit;
    p.method = number.method;
    p.at     = {"{}", {{force, "kN", ".5g"}}};
    p.inputs = inputs;
    p.checks = number.checks;
    p.source = number.source;
    // Zero by symmetry differs between two meshes by rounding alone.
    const double rounding = number.unit == "m" ? 1e-12 : 0;
    p.error_estimate      = std::abs(number.value) <= rounding || number.value == coarse[i].value
                                ? 0
                                : mesh_pair_error(number.value, coarse[i].value);
    run.results.add(number.name, p);
  }
}

std::string pair_name(const Stack &stack, const StackContact &contact)
{
  return stack.rolls[contact.a].name + "-" + stack.rolls[contact.b].name;
}

void warn_of_state(RunContext &run, const SolvedStack &solved)
{
  const Stack &stack = solved.stack;
  for (std::size_t c = 0; c < stack.contacts.size(); ++c) {
    const StackContact &contact = stack.contacts[c];
    const auto &pair            = solved.state.pairs[c];
    if (pair.touching < 1 - 1e-9)
      run.warn(fmt::format("contact {} is open on {:.0f} % of its length", pair_name(stack, contact),
                           100 * (1 - pair.touching)));
    for (const std::size_t r : {contact.a, contact.b})
      if (const double yield = stack.rolls[r].material.yield_stress; pair.peak_pressure > 5 * yield)
        run.warn(fmt::format("contact {}: the peak pressure of {:.0f} MPa is above five times the yield stress of "
                             "roll {}",
                             pair_name(stack, contact), 1e-6 * pair.peak_pressure, stack.rolls[r].name));
  }
  for (const std::size_t r : {stack.upper, stack.lower}) {
    const StackRoll &roll = stack.rolls[r];
    const double to_end   = roll.length / 2 - std::abs(stack.strip.offset - roll.shift) - stack.strip.width / 2;
    if (to_end < 2 * stack.strip.arc)
      run.warn(
          fmt::format("the edge of the strip is {:.4g} mm from the end of the barrel of roll {}, less than twice "
                      "the length of contact: its flattening there is larger than that of the half space",
                      1e3 * to_end, roll.name));
  }
}

void say_what_is_assumed_of(RunContext &run, const StackInput &input)
{
  for (const StackRollInput &roll : input.rolls)
    if (roll.on.empty() && !roll.saddles.given && roll.bearing_stiffness.empty())
      run.assume(fmt::format(
          "the bearings and the housing of roll {} are rigid, since bearing_stiffness is not given", roll.name));
  run.assume(
      "the strip does not flow across the width: its flatness is the difference of elongations that nothing "
      "evens out");
}
}  // namespace

SolvedStack solve_stack(const StackInput &input, const Stack &stack, const int elements_per_width)
{
  if (!std::isnan(input.strip.gap))
    return solve_for_gap(input, stack, elements_per_width);
  reduce::BeamStack engine(stack, settings_of(input, elements_per_width));
  reduce::StackState state = engine.solve();
  return {stack, std::move(engine), std::move(state)};
}

double unloaded_gap(const SolvedStack &solved)
{
  const double exit = solved.stack.strip.exit_thickness;
  return exit > 0 ? exit - mean_opening(solved.state.strip) : not_given;
}

Eigen::VectorXd flatness(const SolvedStack &solved)
{
  const StackStrip &strip         = solved.stack.strip;
  const reduce::StripState &state = solved.state.strip;
  if (!(strip.entry_thickness > 0) || !(strip.exit_thickness > 0))
    return {};
  const Eigen::Index n          = state.opening.size();
  const Eigen::VectorXd length  = state.edges.tail(n) - state.edges.head(n);
  const Eigen::VectorXd entry   = (state.entry.array() + strip.entry_thickness).matrix();
  const Eigen::VectorXd exit    = (state.opening.array() + unloaded_gap(solved)).matrix();
  const Eigen::VectorXd stretch = (entry.array() / exit.array()).log().matrix();
  return (1e5 * (stretch.array() - stretch.dot(length) / length.sum())).matrix();
}

void write_stack_curves(const RunContext &run, const SolvedStack &solved)
{
  const reduce::StripState &strip = solved.state.strip;
  const Eigen::Index n            = strip.opening.size();
  Table profile;
  profile.add("z", "m", (strip.edges.head(n) + strip.edges.tail(n)) / 2)
      .add("opening", "m", strip.opening)
      .add("profile", "m", (strip.opening.array() - strip.middle).matrix())
      .add("line_load", "N/m", strip.load);
  if (const Eigen::VectorXd I = flatness(solved); I.size() > 0)
    profile.add("flatness_I", "", I);
  write_curve(run, curve::stack_strip, "", profile);
  for (std::size_t c = 0; c < solved.stack.contacts.size(); ++c) {
    const StackContact &contact = solved.stack.contacts[c];
    const StackRoll &a = solved.stack.rolls[contact.a], &b = solved.stack.rolls[contact.b];
    const auto &pair = solved.state.pairs[c];
    const auto law =
        reduce::line_law(a.diameter / 2, a.material, b.diameter / 2, b.material, contact.ring_stiffness);
    Eigen::VectorXd width(pair.load.size()), pressure(pair.load.size());
    for (Eigen::Index i = 0; i < width.size(); ++i) {
      width[i]    = pair.load[i] > 0 ? reduce::half_width_of(law, pair.load[i]) : 0;
      pressure[i] = width[i] > 0 ? 2 * pair.load[i] / (M_PI * width[i]) : 0;
    }
    Table table;
    table.add("z", "m", pair.z)
        .add("line_load", "N/m", pair.load)
        .add("half_width", "m", width)
        .add("peak_pressure", "Pa", pressure)
        .add("tangent", "N/m2", pair.tangent);
    write_curve(run, curve::stack_pair, pair_name(solved.stack, contact), table);
  }
  for (std::size_t r = 0; r < solved.stack.rolls.size(); ++r) {
    const auto &roll = solved.state.rolls[r];
    Table table;
    table.add("z", "m", roll.z).add("x", "m", roll.x).add("y", "m", roll.y);
    write_curve(run, curve::stack_roll, solved.stack.rolls[r].name, table);
  }
}

StackNumbers traced_stack(const StackInput &input, const Stack &stack)
{
  return stack_numbers(input, solve_stack(input, stack, elements_over_width / 2));
}

std::vector<std::string> keys_of_stack(const Case &the_case)
{
  std::vector<std::string> keys;
  for (const auto &place : the_case.places)
    if (place.first.find('.') != std::string::npos)  // not the title
      keys.push_back(place.first);
  return keys;
}

void run_stack(RunContext &run, const StackInput &input, const Stack &stack)
{
  StageTimer timer(run, "stack");
  const SolvedStack fine   = solve_stack(input, stack, elements_over_width),
                    coarse = solve_stack(input, stack, elements_over_width / 2);
  const double force       = fine.stack.strip.force;
  add_results(run, stack_numbers(input, fine), stack_numbers(input, coarse), force);
  add_results(run, stack_influences(input, fine), stack_influences(input, coarse), force);
  write_stack_curves(run, fine);
  warn_of_state(run, fine);
  say_what_is_assumed_of(run, input);
}
}  // namespace mill
