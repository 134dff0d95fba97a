#include "app/stack/stack_curves.h"
#include "app/run/curve_files.h"
#include "app/stack/made_roll.h"
#include "app/stack/stack_optimise.h"
#include "core/base/errors.h"
#include "core/model/stack_statics.h"
#include "core/process/parallel.h"
#include "core/records/cluster_record.h"
#include "core/records/json_archive.h"
#include "core/records/stack_names.h"
#include "reduce/stack/line_law.h"
#include "reduce/stack/section_forces.h"
#include "reduce/stack/stations.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr int elements_of_maps = 30;  // over the width
constexpr int forces_of_curve  = 10;

void write_lines(const RunContext &run, const SolvedStack &solved)
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
    const reduce::SectionForces inside = reduce::section_forces(solved.stack, solved.state, r);
    table.add("z", "m", roll.z).add("x", "m", roll.x).add("y", "m", roll.y);
    table.add("moment_x", "N m", inside.moment.col(0)).add("moment_y", "N m", inside.moment.col(1));
    table.add("shear_x", "N", inside.shear.col(0)).add("shear_y", "N", inside.shear.col(1));
    table.add("bending_stress", "Pa", inside.stress);
    write_curve(run, curve::stack_roll, solved.stack.rolls[r].name, table);
  }
}

// Angle of a contact against the vertical, as a drawing has it.
double inclination(const Stack &stack, const StackContact &contact)
{
  const auto n = reduce::direction_of(stack, contact);
  return std::atan2(std::abs(n[0]), std::abs(n[1])) * 180 / M_PI;
}

void write_section(const RunContext &run, const SolvedStack &solved)
{
  const Stack &stack = solved.stack;
  ClusterRecord record;
  record.strip = pair_name(stack.rolls[stack.upper].name, stack.rolls[stack.lower].name);
  ClusterPassRecord state;
  state.name  = "the rolling force";
  state.force = stack.strip.force;
  for (const StackRoll &roll : stack.rolls)
    record.rolls.push_back({roll.name, roll.axis[0], roll.axis[1], roll.diameter / 2, 0});
  const bool inclined = reduce::has_inclined_contact(stack);
  for (std::size_t c = 0; c < stack.contacts.size(); ++c) {
    const StackContact &contact = stack.contacts[c];
    const std::string angle     = inclined ? fmt::format(", {:.1f}\u00b0", inclination(stack, contact)) : "";
    record.contacts.push_back({pair_name(stack, contact) + angle, int(contact.a), int(contact.b), "johnson"});
    ClusterLoadRecord load;
    load.name  = pair_name(stack, contact);
    load.force = solved.state.pairs[c].force;
    state.contacts.push_back(load);
  }
  record.passes.push_back(state);
  run.out.write(stack_file, json_of_record(record));
}

// Of the upper and of the lower roll together, as the results influence.* are.
void write_influences(const RunContext &run, const StackInput &input, const SolvedStack &solved)
{
  const Stack &stack              = solved.stack;
  const reduce::StripState &strip = solved.state.strip;
  const Eigen::Index n            = strip.opening.size();
  Table table;
  table.add("z", "m", (strip.edges.head(n) + strip.edges.tail(n)) / 2);
  const auto about_middle = [](const reduce::GapShape &shape) {
    return (shape.opening.array() - shape.middle).matrix().eval();
  };
  table.add("force", "m/N", about_middle(solved.engine->influence_of_force()));
  for (const StackRollInput &written : input.rolls) {
    Eigen::VectorXd bends = Eigen::VectorXd::Zero(n);
    for (std::size_t r = 0; r < stack.rolls.size(); ++r) {
      const StackRoll &roll = stack.rolls[r];
      if (roll.name != written.name && !is_made_of(roll, written))
        continue;
      const double up = roll.axis[1] > 0 ? 1 : -1;
      if (roll.loads.size() == 2)
        bends += about_middle(
            solved.engine->influence_of_loads(r, {{roll.loads[0].z, {0, up}}, {roll.loads[1].z, {0, up}}}));
      for (std::size_t s = 0; s < roll.supports.size() && written.saddles.given && roll.name == written.name; ++s)
        table.add(fmt::format("{}.eccentric{}", written.name, s + 1), "",
                  about_middle(solved.engine->influence_of_loads(
                      r, {{roll.supports[s].z, {0, -up * roll.supports[s].stiffness[1]}}})));
    }
    if (!bends.isZero(0))
      table.add(written.name + ".bending_force", "m/N", bends);
  }
  write_curve(run, curve::stack_influence, "", table);
}

double least_touching(const reduce::StackState &state)
{
  double least = 1;
  for (const reduce::PairState &pair : state.pairs)
    least = std::min(least, pair.touching);
  return least;
}

double largest_pressure(const reduce::StackState &state)
{
  double largest = 0;
  for (const reduce::PairState &pair : state.pairs)
    largest = std::max(largest, pair.peak_pressure);
  return largest;
}

// A state, or nothing where the stack has no equilibrium or the case would not be accepted.
std::optional<reduce::StackState> state_of(const StackInput &input, const Stack &stack)
{
  for (const StackResultant &resultant : stack_resultants(stack, stack.strip.force))
    if (!(resultant.force > 0))
      return std::nullopt;
  for (const std::size_t r : {stack.upper, stack.lower})
    if (stack.strip.width / 2 + std::abs(stack.strip.offset - stack.rolls[r].shift) > stack.rolls[r].length / 2)
      return std::nullopt;
  try {
    return beams_of(input, elements_of_maps)(stack)->solve();
  } catch (const SolverError &) {
    return std::nullopt;
  }
}

// All settings of two ranges, in parallel; columns in the order of the second setting within the first.
struct Settings {
  Eigen::VectorXd first, second;
  std::vector<std::optional<reduce::StackState>> state;
  Eigen::VectorXd read(const std::function<double(const reduce::StackState &)> &of) const
  {
    Eigen::VectorXd column(first.size());
    for (Eigen::Index i = 0; i < column.size(); ++i)
      column[i] = state[std::size_t(i)] ? of(*state[std::size_t(i)]) : not_given;
    return column;
  }
};
Settings settings_of(RunContext &run, const StackInput &input, const int points,
                     const std::array<double, 2> &first, const std::array<double, 2> &second,
                     const std::function<Stack(double, double)> &stack_at)
{
  const Eigen::Index n = points;
  Settings all{Eigen::VectorXd(n * n), Eigen::VectorXd(n * n), {}};
  all.state.resize(std::size_t(n * n));
  for (Eigen::Index i = 0; i < n * n; ++i) {
    all.first[i]  = first[0] + (first[1] - first[0]) * double(i / n) / double(n - 1);
    all.second[i] = second[0] + (second[1] - second[0]) * double(i % n) / double(n - 1);
  }
  share_tasks(n * n, run.threads, [&](const long i) {
    all.state[std::size_t(i)] = state_of(input, stack_at(all.first[i], all.second[i]));
  });
  return all;
}

void write_modulus(RunContext &run, const StackInput &input, const Stack &stack)
{
  std::vector<std::optional<reduce::StackState>> states(forces_of_curve);
  Eigen::VectorXd force(forces_of_curve);
  share_tasks(forces_of_curve, run.threads, [&](const long i) {
    Stack other       = stack;
    other.strip.force = force[i] = stack.strip.force * 0.25 * std::pow(8., double(i) / (forces_of_curve - 1));
    states[std::size_t(i)]       = state_of(input, other);
  });
  const auto column = [&](const std::function<double(const reduce::StackState &)> &of) {
    return Eigen::VectorXd::NullaryExpr(forces_of_curve,
                                        [&](const Eigen::Index i) {
                                          return states[std::size_t(i)] ? of(*states[std::size_t(i)]) : not_given;
                                        })
        .eval();
  };
  Table table;
  table.add("force", "N", force)
      .add("opening", "m", column([](const auto &s) { return s.strip.middle; }))
      .add("mid", "N/m", column([](const auto &s) { return s.modulus.mid; }))
      .add("mean", "N/m", column([](const auto &s) { return s.modulus.mean; }))
      .add("crown", "m", column([](const auto &s) { return s.strip.crown; }));
  write_curve(run, curve::stack_modulus, "", table);
}

void write_settings(RunContext &run, const StackInput &input, const Stack &stack)
{
  const StackWindow &window   = input.window;
  const StackActuator shifted = stack_actuator(input, stack, window.shifted + ".shift"),
                      bent    = stack_actuator(input, stack, window.bent + ".bending_force");
  const Settings all          = settings_of(run, input, window.points, window.shift, window.bending,
                                            [&](const double shift, const double bending) {
                                     const Stack moved = with_actuator(input, stack, shifted, shift);
                                     return with_actuator(input, moved, bent, bending);
                                   });
  Table table;
  table.add("shift", "m", all.first)
      .add("bending_force", "N", all.second)
      .add("crown", "m", all.read([](const auto &s) { return s.strip.crown; }))
      .add("edge_drop", "m", all.read([](const auto &s) { return s.strip.edge_drop; }))
      .add("touching", "", all.read(least_touching));
  write_curve(run, curve::stack_settings, "", table);
}

void write_window(RunContext &run, const StackInput &input, const Stack &stack)
{
  const Settings all = settings_of(run, input, input.window.points, input.window.width, input.window.force,
                                   [&](const double width, const double force) {
                                     Stack other       = stack;
                                     other.strip.width = width;
                                     other.strip.force = force;
                                     return other;
                                   });
  Table table;
  table.add("width", "m", all.first)
      .add("force", "N", all.second)
      .add("crown", "m", all.read([](const auto &s) { return s.strip.crown; }))
      .add("edge_drop", "m", all.read([](const auto &s) { return s.strip.edge_drop; }))
      .add("peak_pressure", "Pa", all.read(largest_pressure))
      .add("touching", "", all.read(least_touching));
  write_curve(run, curve::stack_window, "", table);
}
}  // namespace

std::string pair_name(const Stack &stack, const StackContact &contact)
{
  return pair_name(stack.rolls[contact.a].name, stack.rolls[contact.b].name);
}

void write_stack_curves(const RunContext &run, const StackInput &input, const SolvedStack &solved)
{
  write_lines(run, solved);
  write_section(run, solved);
  write_influences(run, input, solved);
}

void write_stack_maps(RunContext &run, const StackInput &input, const Stack &stack)
{
  if (!(stack.strip.force > 0))
    return;
  write_modulus(run, input, stack);
  if (!std::isnan(input.window.bending[0]) && !std::isnan(input.window.shift[0]))
    write_settings(run, input, stack);
  if (!std::isnan(input.window.force[0]) && !std::isnan(input.window.width[0]))
    write_window(run, input, stack);
}
}  // namespace mill
