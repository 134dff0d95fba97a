#include "app/stack/stack_stage.h"
#include "app/run/curve_files.h"
#include "core/model/case.h"
#include "core/numerics/mesh_pair.h"
#include "core/records/stack_names.h"
#include "fem/stack/condensed_stack.h"
#include "reduce/stack/beam_stack.h"
#include "reduce/stack/line_law.h"
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace mill {
namespace {
// Errors of the reference cases: docs/theory/51, "Measured".
constexpr int elements_over_width = 60;
constexpr int stations_over_width = 40;  // the meshes of the condensed rolls resolve no more
constexpr int frequencies_shown   = 6;
const char *const by_beams        = "Timoshenko beams and line contacts, equilibrium by Newton's method (51.9)";
const char *const by_condensed = "condensed rolls whose contacts feel each other, equilibrium by Newton's method "
                                 "(51.16)";

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
SolvedStack solve_for_gap(const StackInput &input, Stack stack, const MakeStackEngine &make)
{
  const double wanted      = input.strip.exit_thickness - input.strip.gap;
  constexpr int most_steps = 20;
  stack.strip.force        = 1e3 * stack.strip.width * 1e3;  // N, 1 kN per mm of width to begin with
  for (int step = 0; step < most_steps; ++step) {
    auto engine              = make(stack);
    reduce::StackState state = engine->solve();
    const double missing     = wanted - mean_opening(state.strip);
    if (std::abs(missing) < 1e-9 * wanted)
      return {stack, std::move(engine), std::move(state), {}};
    // Contacts are softer under less load: no step goes below a tenth of the force.
    stack.strip.force = std::max(0.1 * stack.strip.force, stack.strip.force + state.modulus.mean * missing);
  }
  throw SolverError({fmt::format("the rolling force at a gap of {:.6g} mm was not found within {} steps",
                                 1e3 * input.strip.gap, most_steps),
                     fmt::format("{:.5g} kN at the last step", 1e-3 * stack.strip.force),
                     "the gap is far from what the stack can reach with this exit thickness",
                     "give strip.force, and compare stack.gap of that run with strip.gap", ""});
}

// The engine that gives the results, on two meshes, and the other.
struct StackNumberSets {
  StackNumbers fine, coarse, other;
  const char *other_method;
};

void add_results(RunContext &run, const StackNumberSets &sets, const double force)
{
  const auto &[fine, coarse, other, other_method] = sets;
  const std::vector<std::string> inputs           = keys_of_stack(run.the_case);
  std::map<std::string, double> checks;
  for (const StackNumber &number : other)
    checks[number.name] = number.value;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    const StackNumber &number = fine[i];
    // Zero by symmetry is zero but for rounding, which differs between meshes and engines.
    const auto without_rounding = [&](const double value) {
      return number.unit == "m" && std::abs(value) < 1e-12 ? 0 : value;
    };
    Parameter p;
    p.value  = without_rounding(number.value);
    p.unit   = number.unit;
    p.method = number.method;
    p.at     = {"{}", {{force, "kN", ".5g"}}};
    p.inputs = inputs;
    p.checks = number.checks;
    for (Check &check : p.checks)
      check.value = without_rounding(check.value);
    p.source = number.source;
    if (const auto check = checks.find(number.name);
        check != checks.end() && number.source != Source::given && number.unit != "Hz")
      p.checks.push_back({other_method, without_rounding(check->second),
                          "shoulders, the surface of the rolls around their contacts and the flattening at the "
                          "edges of the strip are in the condensed rolls only"});
    p.error_estimate = p.value == 0 || p.value == coarse[i].value ? 0 : mesh_pair_error(p.value, coarse[i].value);
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

MakeStackEngine beams_of(const StackInput &input, const int elements_per_width)
{
  return [settings = settings_of(input, elements_per_width)](const Stack &stack) {
    return std::make_unique<reduce::BeamStack>(stack, settings);
  };
}

MakeStackEngine condensed_of(const StackKernels &kernels, const int stations_per_width)
{
  return [kernels, stations_per_width](const Stack &stack) {
    return std::make_unique<fem::CondensedStack>(stack, kernels, fem::CondensedStackSettings{stations_per_width});
  };
}

MakeStackEngine leading_engine(RunContext &run, const StackInput &input, const Stack &stack)
{
  return input.engine.model == "condensed" ? condensed_of(stack_kernels(run, stack), stations_over_width)
                                           : beams_of(input, elements_over_width);
}

SolvedStack solve_stack(const StackInput &input, const Stack &stack, const MakeStackEngine &make)
{
  SolvedStack solved;
  if (!std::isnan(input.strip.gap))
    solved = solve_for_gap(input, stack, make);
  else {
    solved.stack  = stack;
    solved.engine = make(stack);
    solved.state  = solved.engine->solve();
  }
  if (const auto *beams = dynamic_cast<const reduce::BeamStack *>(solved.engine.get()))
    solved.frequencies = beams->frequencies(frequencies_shown);
  return solved;
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
  return stack_numbers(input, solve_stack(input, stack, beams_of(input, elements_over_width / 2)), by_beams);
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
  const StackKernels kernels = stack_kernels(run, stack);
  const bool is_condensed    = input.engine.model == "condensed";
  const auto engine          = [&](const bool condensed, const int coarser) {
    return condensed ? condensed_of(kernels, stations_over_width / coarser)
                              : beams_of(input, elements_over_width / coarser);
  };
  SolvedStack fine        = solve_stack(input, stack, engine(is_condensed, 1)),
              coarse      = solve_stack(input, stack, engine(is_condensed, 2));
  const SolvedStack other = solve_stack(input, stack, engine(!is_condensed, 1));
  if (is_condensed) {  // condensed rolls have no masses
    fine.frequencies   = other.frequencies;
    coarse.frequencies = solve_stack(input, stack, engine(false, 2)).frequencies;
  }
  const double force       = fine.stack.strip.force;
  const char *method       = is_condensed ? by_condensed : by_beams,
             *other_method = is_condensed ? by_beams : by_condensed;
  StackNumberSets sets{stack_numbers(input, fine, method), stack_numbers(input, coarse, method),
                       stack_numbers(input, other, other_method), other_method};
  for (const auto &[numbers, solved] : {std::pair<StackNumbers *, const SolvedStack *>(&sets.fine, &fine),
                                        {&sets.coarse, &coarse},
                                        {&sets.other, &other}}) {
    const StackNumbers influences = stack_influences(input, *solved);
    numbers->insert(numbers->end(), influences.begin(), influences.end());
  }
  add_results(run, sets, force);
  write_stack_curves(run, fine);
  warn_of_state(run, fine);
  say_what_is_assumed_of(run, input);
}
}  // namespace mill
