#include "app/stack/made_roll.h"
#include "app/stack/stack_optimise.h"
#include "app/stack/stack_stage.h"
#include "core/model/stack_supports.h"
#include "core/records/result_words.h"
#include "core/records/rows_of_stack.h"
#include "core/records/stack_names.h"
#include "reduce/stack/line_law.h"
#include "reduce/stack/section_forces.h"
#include "reduce/stack/stations.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace mill {
Stack loaded_where_solved(const SolvedStack &solved)
{
  const reduce::StripState &strip = solved.state.strip;
  const Eigen::Index n            = strip.load.size();
  const Eigen::VectorXd force     = strip.load.cwiseProduct(strip.edges.tail(n) - strip.edges.head(n));
  const Eigen::VectorXd centre    = (strip.edges.tail(n) + strip.edges.head(n)) / 2;
  const double off_middle         = force.dot(centre) / force.sum();
  constexpr double rounding       = 1e-9;  // of the width: forces are balanced to 1e-10 of the rolling force
  Stack loaded                    = solved.stack;
  if (std::abs(off_middle) > rounding * loaded.strip.width)
    loaded.strip.offset += off_middle;
  return loaded;
}

namespace {
const char *const by_factors = "exact derivative at the solved state, by the factors of Newton's last step";
const char *const by_statics = "statics of rigid rolls (51.11)";

// Root mean square of h about its mean over the width; elements may differ in length.
double profile_rms(const reduce::StripState &strip)
{
  const Eigen::Index n         = strip.opening.size();
  const Eigen::VectorXd length = strip.edges.tail(n) - strip.edges.head(n);
  const double mean            = length.dot(strip.opening) / length.sum();
  return std::sqrt(length.dot((strip.opening.array() - mean).square().matrix()) / length.sum());
}

void add_strip_numbers(StackNumbers &all, const SolvedStack &solved, const bool given_force, const char *by_newton)
{
  const reduce::StripState &strip = solved.state.strip;
  const std::string profile       = std::string(by_newton) + ", opening (51.2)";
  const auto add                  = [&](const RowOf<0> &row, const double value, std::string method) {
    all.push_back({row.of(), value, row.unit, std::move(method), {}});
  };
  if (given_force) {
    add(row::stack::force, solved.stack.strip.force, "");
    all.back().source = Source::given;
  } else {
    add(row::stack::force, solved.stack.strip.force, "that at which the unloaded gap is the given one");
  }
  add(row::stack::crown, strip.crown, profile);
  add(row::stack::edge_drop, strip.edge_drop, profile);
  add(row::stack::wedge, strip.wedge, profile);
  add(row::stack::profile_rms, profile_rms(strip), profile);
  add(row::stack::opening, strip.middle, profile);
  if (const double gap = unloaded_gap(solved); !std::isnan(gap))
    add(row::stack::gap, gap, "mean exit thickness less the mean opening (51.2)");
  add(row::stack::modulus_mid, solved.state.modulus.mid, by_factors);
  add(row::stack::modulus_mean, solved.state.modulus.mean, by_factors);
  if (const Eigen::VectorXd I = flatness(solved); I.size() > 0) {
    add(row::stack::flatness_min, I.minCoeff(), "I-units, no lateral flow (51.12)");
    add(row::stack::flatness_max, I.maxCoeff(), "I-units, no lateral flow (51.12)");
  }
}

// Where the load of the strip lies, if that is not its middle; else empty.
std::string load_of_strip(const SolvedStack &solved)
{
  constexpr double seen = 1e-5;  // m
  const double centre   = loaded_where_solved(solved).strip.offset;
  return std::abs(centre - solved.stack.strip.offset) < seen
             ? ""
             : fmt::format("with the load of the strip at {:.5g} mm, where its line load puts it", 1e3 * centre);
}

void add_pair_numbers(StackNumbers &all, const SolvedStack &solved, const std::size_t c,
                      const StackResultant &resultant, const char *by_newton)
{
  const StackContact &contact = solved.stack.contacts[c];
  const StackRoll &a = solved.stack.rolls[contact.a], &b = solved.stack.rolls[contact.b];
  const reduce::PairState &pair = solved.state.pairs[c];
  const auto law =
      reduce::line_law(a.diameter / 2, a.material, b.diameter / 2, b.material, contact.ring_stiffness);
  double length = 0;
  for (const auto &[from, to] : reduce::contact_zones(solved.stack, contact))
    length += to - from;
  const double even = resultant.force / length, even_width = reduce::half_width_of(law, even);
  const auto add = [&](const RowOf<1> &row, const double value, std::string method, std::vector<Check> checks) {
    all.push_back({row.of(a.name + "-" + b.name), value, row.unit, std::move(method), std::move(checks)});
  };
  const std::string where = load_of_strip(solved);
  add(row::pair::force, pair.force, by_newton, {{by_statics, resultant.force, ""}});
  const bool presses = pair.force > 0;  // an open contact has neither a centre nor a stiffness
  if (presses)
    add(row::pair::load_centre, pair.load_centre, by_newton, {{by_statics, resultant.centre, where}});
  const std::string uneven = "the load is not uniform";
  add(row::pair::q_max, pair.peak_load, by_newton, {{"mean over the length of contact", even, uneven}});
  if (presses)
    add(row::pair::peak_pressure, pair.peak_pressure, "Hertz, largest line load (51.3)",
        {{"Hertz, uniform load", 2 * even / (M_PI * even_width), uneven}});
  add(row::pair::touching, pair.touching, by_newton, {});
  add(row::pair::uniform_tangent, pair.uniform_tangent, "integral of dq/dd along the contact (51.4)",
      {{"uniform load (51.4)", length / reduce::compliance_of(law, even), uneven}});
  if (!presses)
    return;
  add(row::pair::tangent, pair.loaded_tangent,
      "change of the force over that of the approach, which the line load weighs (51.21)",
      {{"uniform load (51.4)", length / reduce::compliance_of(law, even), uneven}});
  const double weighted = (pair.weight.array() * pair.load.array() * pair.approach.array()).sum() / pair.force;
  add(row::pair::secant, pair.force / weighted, "force over the approach, which the line load weighs (51.3)",
      {{"uniform load (51.3)", resultant.force / reduce::approach_of(law, even), uneven}});
}

void add_roll_numbers(StackNumbers &all, const SolvedStack &solved, const std::size_t r,
                      const std::vector<StackResultant> &resultants, const char *by_newton)
{
  const StackRoll &roll                    = solved.stack.rolls[r];
  const reduce::StackState &state_of_stack = solved.state;
  const reduce::RollState &state           = state_of_stack.rolls[r];
  const auto add = [&](const ResultName &name, const double value, std::vector<Check> checks) {
    all.push_back({name, value, name.row().unit, by_newton, std::move(checks)});
  };
  std::vector<std::pair<double, double>> reactions;  // by z
  for (std::size_t s = 0; s < roll.supports.size(); ++s)
    reactions.emplace_back(roll.supports[s].z, state.reactions[s]);
  std::sort(reactions.begin(), reactions.end());
  if (reactions.size() == 2) {
    const Eigen::RowVector2d balance = support_forces(loaded_where_solved(solved), r, resultants).row(1);
    const Eigen::Index drive         = roll.supports[1].z > roll.supports[0].z ? 1 : 0;
    const std::string where          = load_of_strip(solved);
    add(row::roll::reaction_drive.of(roll.name), reactions[1].second, {{by_statics, balance[drive], where}});
    add(row::roll::reaction_operator.of(roll.name), reactions[0].second,
        {{by_statics, balance[1 - drive], where}});
  } else {
    for (std::size_t s = 0; s < reactions.size(); ++s)
      add(row::roll::reaction_saddle.of(roll.name, std::to_string(s + 1)), reactions[s].second, {});
  }
  const auto y_at = [&](const double z) {
    const auto next = std::lower_bound(state.z.begin(), state.z.end(), z);
    const auto i    = std::clamp<Eigen::Index>(next - state.z.begin(), 1, state.z.size() - 1);
    const double t  = (z - state.z[i - 1]) / (state.z[i] - state.z[i - 1]);
    return (1 - t) * state.y[i - 1] + t * state.y[i];
  };
  add(row::roll::deflection.of(roll.name),
      y_at(roll.shift) - (y_at(roll.shift - roll.length / 2) + y_at(roll.shift + roll.length / 2)) / 2, {});
  all.push_back({row::roll::bending_stress.of(roll.name),
                 reduce::largest_bending_stress(solved.stack, state_of_stack, r),
                 "Pa",
                 "largest bending moment over the section modulus, plane sections (51.24)",
                 {}});
}
}  // namespace

StackNumbers stack_numbers(const StackInput &input, const SolvedStack &solved, const char *method)
{
  StackNumbers all;
  const auto resultants = stack_resultants(loaded_where_solved(solved), solved.stack.strip.force);
  add_strip_numbers(all, solved, std::isnan(input.strip.gap), method);
  for (std::size_t c = 0; c < solved.stack.contacts.size(); ++c)
    add_pair_numbers(all, solved, c, resultants[c], method);
  for (std::size_t r = 0; r < solved.stack.rolls.size(); ++r)
    add_roll_numbers(all, solved, r, resultants, method);
  return all;
}

namespace {
const char *const by_difference = "central difference over 2 mm: a shift moves the places of contact";

// Of a roll that is shifted, or that a map shifts.
void add_influence_of_shift(StackNumbers &all, const StackInput &input, const SolvedStack &solved,
                            const MakeStackEngine &make, const StackRollInput &written)
{
  const bool stays = input.settings.bending_at == BendingAt::window;  // bending forces move along the shifted roll
  if (stays || (written.axial_shift == 0 && input.window.shifted != written.name))
    return;
  const StackActuator shift = stack_actuator(input, solved.stack, written.name + ".shift");
  std::array<reduce::StripState, 2> strip;
  for (const std::size_t side : {0, 1})
    strip[side] = make(with_actuator(input, solved.stack, shift, shift.present + (side ? 1 : -1) * shift_step))
                      ->solve()
                      .strip;
  for (const auto &[what, low, high] : {std::tuple{"crown", strip[0].crown, strip[1].crown},
                                        {"edge_drop", strip[0].edge_drop, strip[1].edge_drop}})
    all.push_back(
        {row::influence::shift.of(what, written.name), (high - low) / (2 * shift_step), "1", by_difference, {}});
}
}  // namespace

StackNumbers stack_influences(const StackInput &input, const SolvedStack &solved, const MakeStackEngine &make)
{
  StackNumbers all;
  const std::string crown_drop[] = {word_of(ResultWord::crown), word_of(ResultWord::edge_drop)};
  const auto add = [&](const auto &row, const double crown, const double edge_drop, const auto &...of) {
    all.push_back({row.of(crown_drop[0], of...), crown, row.unit, by_factors, {}});
    all.push_back({row.of(crown_drop[1], of...), edge_drop, row.unit, by_factors, {}});
  };
  const Stack &stack              = solved.stack;
  const auto &engine              = *solved.engine;
  const reduce::GapShape by_force = engine.influence_of_force();
  add(row::influence::force, by_force.crown, by_force.edge_drop);
  for (const StackRollInput &written : input.rolls) {
    double crown = 0, drop = 0, bend_crown = 0, bend_drop = 0;
    for (std::size_t r = 0; r < stack.rolls.size(); ++r) {
      const StackRoll &roll = stack.rolls[r];
      const bool made       = is_made_of(roll, written);
      if (roll.name != written.name && !made)
        continue;
      const auto parabola = [&](const double z) {  // the diameter is 1 m larger at mid-barrel than at its ends
        return -0.5 * std::pow(2 * (z - roll.shift) / roll.length, 2);
      };
      const reduce::GapShape by_crown = engine.influence_of_radius(r, parabola);
      crown += by_crown.crown;
      drop += by_crown.edge_drop;
      if (roll.loads.size() == 2) {
        const double up = roll.axis[1] > 0 ? 1 : -1;
        const reduce::GapShape by_bending =
            engine.influence_of_loads(r, {{roll.loads[0].z, {0, up}}, {roll.loads[1].z, {0, up}}});
        bend_crown += by_bending.crown;
        bend_drop += by_bending.edge_drop;
      }
      // A saddle that moves by 1 m towards the strip pushes with its stiffness.
      for (std::size_t s = 0; s < roll.supports.size() && written.saddles.given && !made; ++s) {
        const double push            = (roll.axis[1] > 0 ? -1 : 1) * roll.supports[s].stiffness[1];
        const reduce::GapShape shape = engine.influence_of_loads(r, {{roll.supports[s].z, {0, push}}});
        add(row::influence::eccentric, shape.crown, shape.edge_drop, written.name, std::to_string(s + 1));
      }
    }
    add(row::influence::crown, crown, drop, written.name);
    if (bend_crown != 0)
      add(row::influence::bending_force, bend_crown, bend_drop, written.name);
    add_influence_of_shift(all, input, solved, make, written);
  }
  return all;
}
}  // namespace mill
