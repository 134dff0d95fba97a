#include "app/stack/stack_stage.h"
#include "app/command/linked_subjects.h"
#include "app/run/curve_files.h"
#include "app/stack/stack_bearings.h"
#include "app/stack/stack_bite.h"
#include "app/stack/stack_curves.h"
#include "app/stack/stack_motion.h"
#include "app/stack/stack_warnings.h"
#include "app/stages/bearing/bearing_results.h"
#include "core/base/si_unit.h"
#include "core/case/provenance.h"
#include "core/model/case.h"
#include "core/numerics/mesh_pair.h"
#include "core/records/rows_of_stack.h"
#include "core/records/stack_names.h"
#include "fem/stack/condensed_stack.h"
#include "reduce/stack/beam_stack.h"
#include "reduce/stack/line_law.h"
#include "reduce/stack/section_forces.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <set>
#include <utility>

namespace mill {
namespace {
// Errors of the reference cases: docs/theory/51, "Measured".
constexpr int elements_over_width = 60;
constexpr int stations_over_width = 40;  // the meshes of the condensed rolls resolve no more
const char *const by_beams        = "Timoshenko beams and line contacts, equilibrium by Newton's method (51.9)";
const char *const by_condensed = "condensed rolls whose contacts feel each other, equilibrium by Newton's method "
                                 "(51.16)";

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
  const double tolerance   = std::max(1e-9 * std::abs(wanted), 1e-10 * input.strip.exit_thickness);  // m
  constexpr int most_steps = 20;
  stack.strip.force        = 1e3 * stack.strip.width * 1e3;  // N, 1 kN per mm of width to begin with
  SolvedStack solved;
  for (int step = 0; step < most_steps; ++step) {
    solved.stack = stack;
    if (!solved.engine || !solved.engine->change(stack))
      solved.engine = make(stack);
    solved.state         = solved.engine->solve();
    const double missing = wanted - mean_opening(solved.state.strip);
    if (std::abs(missing) < tolerance)
      return solved;
    // Contacts are softer under less load: no step goes below a tenth of the force.
    stack.strip.force = std::max(0.1 * stack.strip.force, stack.strip.force + solved.state.modulus.mean * missing);
  }
  throw SolverError({fmt::format("the rolling force at a gap of {:.6g} mm was not found within {} steps",
                                 1e3 * input.strip.gap, most_steps),
                     fmt::format("{:.5g} kN at the last step", 1e-3 * stack.strip.force),
                     "the gap is far from what the stack can reach with this exit thickness",
                     "give strip.force, and compare stack.gap of that run with strip.gap", ""});
}

// Zero by symmetry is zero but for rounding, which differs between meshes, engines and bearings.
double without_rounding(const std::string &unit, const double value)
{
  return is_in(unit, SiUnit::metre) && std::abs(value) < 1e-12 ? 0 : value;
}

// The engine that gives the results, on two meshes, and the other; empty where one has no equilibrium.
struct StackNumberSets {
  StackNumbers fine, coarse, other;
  const char *other_method;
};

// By how much the results move, relative to each, with the errors of the bearings that hold rolls.
struct BearingErrors {
  std::map<std::string, double> square;               // by the name of the result: sum over the bearings
  std::map<std::string, std::set<std::string>> lack;  // the bearings without an error that move a result
};

// Beams answer to a spring as condensed rolls do, in a hundredth of the time.
BearingErrors bearing_errors(const StackInput &input, const Stack &stack, const StackBearings &bearings,
                             const int threads)
{
  constexpr double unknown = 0.1, moves = 1e-6;
  const MakeStackEngine beams = beams_of(input, elements_over_width, threads);
  const auto numbers_of       = [&](const Stack &held) {
    const SolvedStack solved      = solve_stack(input, held, beams);
    StackNumbers numbers          = stack_numbers(input, solved, by_beams);
    const StackNumbers influences = stack_influences(input, solved, beams);
    numbers.insert(numbers.end(), influences.begin(), influences.end());
    return numbers;
  };
  BearingErrors errors;
  if (bearings.empty())
    return errors;
  const StackNumbers held = numbers_of(stack);
  for (const auto &[name, study] : bearings) {
    const double error         = tangent_of(study, {}).error_estimate;
    const bool known           = std::isfinite(error);
    const StackNumbers changed = numbers_of(with_softer_bearing(stack, name, known ? error : unknown));
    std::map<std::string, double> moved;
    for (const StackNumber &number : changed)
      moved[number.name] = number.value;
    for (const StackNumber &number : held) {
      const double value  = without_rounding(number.unit, number.value);
      const auto there    = moved.find(number.name);
      const double change = value == 0 || there == moved.end() ? 0 : there->second / value - 1;
      if (!std::isfinite(change))
        continue;  // it is left out of this state
      if (known)
        errors.square[number.name] += change * change;
      else if (std::abs(change) > moves)
        errors.lack[number.name].insert("bearing." + name);
    }
  }
  return errors;
}

// The same number of the other engine; NaN where it has none.
double by_other_engine(const StackNumberSets &sets, const StackNumber &number)
{
  const auto other = std::find_if(sets.other.begin(), sets.other.end(),
                                  [&](const StackNumber &one) { return one.name.text() == number.name.text(); });
  return other == sets.other.end() ? not_given : other->value;
}

// The engines may differ more than their meshes, most where a number is a small difference of large ones.
double with_engines(const double of_meshes, const StackNumberSets &sets, const StackNumber &number)
{
  const double apart = std::abs(number.value - by_other_engine(sets, number));
  return std::isfinite(apart) ? std::max(of_meshes, apart / std::abs(number.value)) : of_meshes;
}

void add_results(RunContext &run, const StackNumberSets &sets, const BearingErrors &of_bearings,
                 const double force)
{
  const auto &[fine, coarse, other, other_method] = sets;
  const std::vector<std::string> inputs           = keys_of_stack(run.the_case);
  std::map<std::string, double> checks, by_coarse;
  for (const StackNumber &number : other)
    checks[number.name] = number.value;
  for (const StackNumber &number : coarse)
    by_coarse[number.name] = without_rounding(number.unit, number.value);
  for (const StackNumber &number : fine) {
    if (std::isnan(number.value))
      continue;
    Parameter p;
    p.value  = without_rounding(number.unit, number.value);
    p.unit   = number.unit;
    p.method = number.method;
    p.at     = {"{}", {{force, "kN", ".5g"}}};
    p.inputs = inputs;
    p.checks = number.checks;
    for (Check &check : p.checks)
      check.value = without_rounding(number.unit, check.value);
    p.source = number.source;
    if (const auto check = checks.find(number.name); check != checks.end() && number.source != Source::given)
      p.checks.push_back({other_method, without_rounding(number.unit, check->second),
                          "shoulders, the surface of the rolls around their contacts and the flattening at the "
                          "edges of the strip are in the condensed rolls only"});
    const auto coarser   = by_coarse.find(number.name);
    const double halved  = coarser == by_coarse.end() ? not_given : coarser->second;
    const bool undefined = std::isnan(halved) || (p.value == 0 && halved != 0);  // no share of zero
    p.error_estimate     = undefined ? not_given : p.value == halved ? 0 : mesh_pair_error(p.value, halved);
    if (p.value != 0 && number.source != Source::given)
      p.error_estimate = with_engines(p.error_estimate, sets, number);
    if (const auto by = of_bearings.square.find(number.name); by != of_bearings.square.end())
      p.error_estimate = std::hypot(p.error_estimate, std::sqrt(by->second));
    if (const auto by = of_bearings.lack.find(number.name); by != of_bearings.lack.end()) {
      p.error_estimate = not_given;
      p.error_lacks.assign(by->second.begin(), by->second.end());
    }
    run.results.add(number.name, p);
  }
}

// Where the engines differ by more than is usual of a profile.
void warn_of_engines(RunContext &run, const StackNumberSets &sets)
{
  constexpr double share = 0.1, least = 2e-6;  // -, m
  static const std::array<const ResultRow *, 3> profile = {&row::stack::crown, &row::stack::edge_drop,
                                                           &row::stack::wedge};
  for (const StackNumber &number : sets.fine) {
    const double other = by_other_engine(sets, number), apart = std::abs(number.value - other);
    if (std::find(profile.begin(), profile.end(), &number.name.row()) == profile.end() || !(apart > least) ||
        !(apart > share * std::max(std::abs(number.value), std::abs(other))))
      continue;
    run.warn({WarningId::stack_engines,
              number.name.text(),
              fmt::format("the engines differ by {:.1f} um, which is taken as its error", 1e6 * apart),
              "bending and shift leave a small difference of large numbers",
              "",
              {number.name.text()}});
  }
}
}  // namespace

reduce::BeamStackSettings beam_settings(const StackInput &input, const int elements_per_width, const int threads)
{
  reduce::BeamStackSettings settings;
  settings.elements_per_width = elements_per_width;
  settings.flattening         = input.engine.flattening == StackFlattening::local ? reduce::Flattening::local
                                                                                  : reduce::Flattening::half_space;
  settings.threads            = threads;
  return settings;
}

MakeStackEngine beams_of(const StackInput &input, const int elements_per_width, const int threads)
{
  return [settings = beam_settings(input, elements_per_width, threads)](const Stack &stack) {
    return std::make_unique<reduce::BeamStack>(stack, settings);
  };
}

MakeStackEngine condensed_of(const StackKernels &kernels, const int stations_per_width, const int threads)
{
  return [kernels, settings = fem::CondensedStackSettings{stations_per_width, threads}](const Stack &stack) {
    return std::make_unique<fem::CondensedStack>(stack, kernels, settings);
  };
}

MakeStackEngine leading_engine(RunContext &run, const StackInput &input, const Stack &stack)
{
  return input.engine.model == StackModel::condensed
             ? condensed_of(stack_kernels(run, stack), stations_over_width, run.threads)
             : beams_of(input, elements_over_width, run.threads);
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
  return solved;
}

void solve_from(SolvedStack &solved, const StackInput &input, const Stack &stack, const MakeStackEngine &make)
{
  if (std::isnan(input.strip.gap) && solved.engine && solved.engine->change(stack))
    try {
      solved.stack = stack;
      solved.state = solved.engine->solve();
      return;
    } catch (const SolverError &) {
      solved.engine.reset();  // the last state was no start for this one
    }
  solved = solve_stack(input, stack, make);
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
  const Eigen::Index n         = state.opening.size();
  const Eigen::VectorXd length = state.edges.tail(n) - state.edges.head(n);
  const Eigen::VectorXd entry  = (state.entry.array() + strip.entry_thickness).matrix();
  const Eigen::VectorXd exit   = (state.opening.array() + unloaded_gap(solved)).matrix();
  if (!(exit.minCoeff() > 0))
    return {};
  const Eigen::VectorXd stretch = (entry.array() / exit.array()).log().matrix();
  return (1e5 * (stretch.array() - stretch.dot(length) / length.sum())).matrix();
}

StackNumbers traced_stack(const StackInput &input, const Stack &stack)
{
  const SolvedStack solved = solve_stack(input, stack, beams_of(input, elements_over_width / 2));
  StackNumbers all         = stack_numbers(input, solved, by_beams);
  all.erase(std::remove_if(all.begin(), all.end(), [](const StackNumber &one) { return std::isnan(one.value); }),
            all.end());
  for (StackNumber &number : all)
    number.value = without_rounding(number.unit, number.value);
  const Eigen::VectorXd f =
      dynamic_cast<const reduce::BeamStack &>(*solved.engine).frequencies(frequencies_listed);
  for (Eigen::Index k = 0; k < f.size(); ++k)
    all.push_back({row::stack::frequency.of(std::to_string(k + 1)), f[k], "Hz", by_beams, {}});
  return all;
}

std::vector<std::string> all_keys_of_stack(const Case &the_case)
{
  std::vector<std::string> keys;
  for (const auto &place : the_case.places)
    if (place.first.find('.') != std::string::npos)  // not the title
      keys.push_back(place.first);
  return keys;
}

std::vector<std::string> keys_of_stack(const Case &the_case)
{
  const StackInput &input = *std::get<StackCase>(the_case.spec).input;
  const bool of_bite      = input.strip.law == StackStripLaw::bite;
  KeyList keys;
  for (const RollerBearing &bearing : input.bearings)
    if (std::any_of(input.rolls.begin(), input.rolls.end(),
                    [&](const StackRollInput &roll) { return roll.bearing == bearing.name; }))
      keys = joined(std::move(keys), bearing_keys(bearing));
  for (const std::string &key : all_keys_of_stack(the_case)) {
    const auto in = [&](const char *start) { return key.rfind(start, 0) == 0; };
    const bool moves =
        in("pass.") || in("dynamics.") || in("stand.") || in("analysis.") || in("window.") || in("bearing.");
    const bool bites = in("strip.friction") || in("strip.flow_stress") || in("strip.entry_tension") ||
                       in("strip.exit_tension") || in("strip.initial_thickness") || in("strip.youngs_modulus") ||
                       in("strip.poisson_ratio");
    if (!moves && (of_bite || !bites))
      keys.push_back(key);
  }
  return keys;
}

namespace {
// Small motion about the solved states of all passes; of the first one the modes.
void move_stack(RunContext &run, const StackInput &input, const Stack &stack, const Goal goal)
{
  StageTimer timer(run, "modes");
  const std::vector<MovingPass> passes = moving_passes(input, stack, run.threads);
  const MovingPass &first              = passes.front();
  if (goal == Goal::chatter) {
    linked_subjects.stack_chatter(run, input, passes);
    return;
  }
  add_stack_modes(run, input, first, moving_pass(input, stack, first.pass, elements_over_width / 2, run.threads));
  run.assume(fmt::format("modal damping of {:g} % in every mode", 100 * input.dynamics.modal_damping));
  if (goal < Goal::simulate)
    return;
  simulate_stack(run, input, passes);
  add_stack_speeds(run, input, passes);
}

// What the slab theory refuses of a pass is known before anything that takes long.
void refuse_bites_of_passes(const StackInput &input, Stack stack)
{
  const double force = stack.strip.force;
  for (const Pass &pass : input.passes) {
    stack.strip.force = std::isnan(pass.load) ? force : pass.load;
    with_slopes_of_bite(input, stack, pass);
  }
}

void solve_state(RunContext &run, const StackInput &input, const Stack &stack, const StackBearings &bearings,
                 double &force);
}  // namespace

void run_stack(RunContext &run, const StackInput &input, const Stack &drawn, const Goal goal)
{
  const StackBearings bearings = solve_stack_bearings(run, input, drawn);
  Stack stack                  = with_slopes_of_bite(input, with_bearing_curves(drawn, bearings));
  refuse_bites_of_passes(input, stack);
  if (goal >= Goal::simulate && goal != Goal::chatter)
    solve_state(run, input, stack, bearings, stack.strip.force);
  else if (!std::isnan(input.strip.gap))
    stack.strip.force =
        solve_stack(input, stack, beams_of(input, elements_over_width, run.threads)).stack.strip.force;
  move_stack(run, input, stack, goal);
}

namespace {
BearingErrors errors_of_bearings(RunContext &run, const StackInput &input, const Stack &stack,
                                 const StackBearings &bearings, const StackNumbers &numbers)
{
  try {
    return bearing_errors(input, stack, bearings, run.threads);
  } catch (const SolverError &) {  // of the beams: what a softer bearing changes stays unknown
    BearingErrors errors;
    for (const StackNumber &number : numbers)
      for (const auto &bearing : bearings)
        errors.lack[number.name].insert("bearing." + bearing.first);
    return errors;
  }
}

void solve_state(RunContext &run, const StackInput &input, const Stack &stack, const StackBearings &bearings,
                 double &force_found)
{
  StageTimer timer(run, "stack");
  const StackKernels kernels = stack_kernels(run, stack);
  const bool is_condensed    = input.engine.model == StackModel::condensed;
  const auto engine          = [&](const bool condensed, const int coarser) {
    return condensed ? condensed_of(kernels, stations_over_width / coarser, run.threads)
                              : beams_of(input, elements_over_width / coarser, run.threads);
  };
  const char *other_method = is_condensed ? by_beams : by_condensed;
  const auto numbers_of    = [&](const SolvedStack &solved, const bool condensed, const int coarser) {
    StackNumbers numbers          = stack_numbers(input, solved, condensed ? by_condensed : by_beams);
    const StackNumbers influences = stack_influences(input, solved, engine(condensed, coarser));
    numbers.insert(numbers.end(), influences.begin(), influences.end());
    return numbers;
  };
  // What only judges the results does not end a run that has them.
  const auto judging = [&](const bool condensed, const int coarser, const char *what, const char *lacks) {
    try {
      return numbers_of(solve_stack(input, stack, engine(condensed, coarser)), condensed, coarser);
    } catch (const SolverError &e) {
      run.warn({WarningId::stack_engines, "", fmt::format("no answer by {}: {}", what, e.report.what), lacks});
      return StackNumbers{};
    }
  };
  const SolvedStack fine = solve_stack(input, stack, engine(is_condensed, 1));
  const double force     = fine.stack.strip.force;
  force_found            = force;
  const StackNumberSets sets{numbers_of(fine, is_condensed, 1),
                             judging(is_condensed, 2, "half as many elements", "results have no error estimate"),
                             judging(!is_condensed, 1, is_condensed ? "beams" : "condensed rolls",
                                     "results are not compared with those of the other engine"),
                             other_method};
  add_results(run, sets, errors_of_bearings(run, input, stack, bearings, sets.fine), force);
  add_stack_bearings(run, input, loaded_where_solved(fine), bearings);
  write_stack_curves(run, input, fine);
  write_stack_maps(run, input, stack);
  warn_of_state(run, fine);
  warn_of_engines(run, sets);
  note_missing_tangents(run, sets.fine);
  say_what_is_assumed_of(run, input);
}
}  // namespace
}  // namespace mill
