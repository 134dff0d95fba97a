#include "app/stack/stack_optimise.h"
#include "app/stack/made_roll.h"
#include "core/base/errors.h"
#include "core/numerics/bounded_least_squares.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <functional>

namespace mill {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double micrometre = 1e-6;  // m, distance from a target that weighs as much as
constexpr double least_move = 1e-3;  // a thousandth of a range squared
constexpr double settled    = 1e-6;  // of the ranges
constexpr int most_steps    = 20;
constexpr int most_halvings = 8;

// The listed roll and the one that is made of it.
void each_roll(const StackInput &input, Stack &stack, const StackActuator &actuator,
               const std::function<void(StackRoll &, bool made)> &change)
{
  const StackRollInput &written = input.rolls[actuator.roll];
  for (StackRoll &roll : stack.rolls)
    if (roll.name == written.name || is_made_of(roll, written))
      change(roll, is_made_of(roll, written));
}

template <class Shape> double value_of(const StackGoal target, const Shape &shape)
{
  return target == StackGoal::crown ? shape.crown : target == StackGoal::edge_drop ? shape.edge_drop : shape.wedge;
}

// Influences of one actuator on the targets, at a solved state.
VectorXd influences(const StackInput &input, const SolvedStack &solved, const MakeStackEngine &make,
                    const StackActuator &actuator, const double value, const std::vector<StackTarget> &targets)
{
  VectorXd sum = VectorXd::Zero(Index(targets.size()));
  if (actuator.kind == StackActuatorKind::shift) {
    SolvedStack moved;
    for (const double side : {-1., 1.}) {
      StackActuator from = actuator;
      from.present       = value;
      solve_from(moved, input, with_actuator(input, solved.stack, from, value + side * shift_step), make);
      for (Index t = 0; t < sum.size(); ++t)
        sum[t] += side * value_of(targets[std::size_t(t)].goal, moved.state.strip) / (2 * shift_step);
    }
    return sum;
  }
  const StackRollInput &written = input.rolls[actuator.roll];
  for (std::size_t r = 0; r < solved.stack.rolls.size(); ++r) {
    const StackRoll &roll = solved.stack.rolls[r];
    const bool made       = is_made_of(roll, written);
    if (roll.name != written.name && !made)
      continue;
    const double up = roll.axis[1] > 0 ? 1 : -1;
    std::vector<StackLoad> unit;
    if (actuator.kind == StackActuatorKind::bending)
      for (const StackLoad &load : roll.loads)
        unit.push_back({load.z, {0, up}});
    else if (!made)
      unit.push_back({roll.supports[actuator.saddle].z, {0, -up * roll.supports[actuator.saddle].stiffness[1]}});
    if (unit.empty())
      continue;
    const reduce::GapShape shape = solved.engine->influence_of_loads(r, unit);
    for (Index t = 0; t < sum.size(); ++t)
      sum[t] += value_of(targets[std::size_t(t)].goal, shape);
  }
  return sum;
}

// The stack at some values of the actuators.
Stack stack_at(const StackInput &input, Stack stack, const std::vector<StackActuator> &actuators,
               const VectorXd &values)
{
  for (std::size_t a = 0; a < actuators.size(); ++a)
    stack = with_actuator(input, stack, actuators[a], values[Index(a)]);
  return stack;
}
}  // namespace

StackActuator stack_actuator(const StackInput &input, const Stack &stack, const std::string &name)
{
  const auto dot = name.find('.');
  StackActuator actuator;
  actuator.name = name;
  while (actuator.roll < input.rolls.size() && input.rolls[actuator.roll].name != name.substr(0, dot))
    ++actuator.roll;
  if (dot == std::string::npos || actuator.roll == input.rolls.size())
    throw InputError("no roll of the stack has the actuator " + name +
                     "; W.bending_force, I.shift and B.eccentric3 are actuators of rolls W, I and B");
  const StackRollInput &written = input.rolls[actuator.roll];
  const std::string what        = name.substr(dot + 1);
  const auto roll               = std::find_if(stack.rolls.begin(), stack.rolls.end(),
                                               [&](const StackRoll &r) { return r.name == written.name; });
  const auto kind               = choice_named<StackActuatorKind>(what);
  if (kind == StackActuatorKind::bending) {
    if (roll->loads.size() != 2)
      throw InputError("roll " + written.name + " has no chocks that bend it; give its bearing_span");
    actuator.present = (written.bending_force[0] + written.bending_force[1]) / 2;
  } else if (kind == StackActuatorKind::shift) {
    if (input.settings.bending_at == BendingAt::window && !roll->loads.empty())
      throw InputError("shift of roll " + written.name +
                       ": its bending forces stay in the window and move along the roll; vary roll.shift with "
                       "millstand sweep instead");
    actuator.kind    = StackActuatorKind::shift;
    actuator.present = written.axial_shift;
  } else if (what.rfind(word_of(StackActuatorKind::eccentric), 0) == 0) {
    actuator.kind    = StackActuatorKind::eccentric;
    const int saddle = std::atoi(what.c_str() + 9);
    if (!written.saddles.given || saddle < 1 || saddle > int(written.saddles.positions.size()))
      throw InputError(fmt::format("roll {} has {} saddles; {} is not one of their eccentrics", written.name,
                                   written.saddles.positions.size(), name));
    actuator.saddle  = std::size_t(saddle - 1);
    actuator.present = written.saddles.eccentric.empty() ? 0 : written.saddles.eccentric[actuator.saddle];
  } else
    throw InputError("no actuator " + what +
                     " of a roll; bending_force, shift and eccentric1, eccentric2, ... are");
  return actuator;
}

Stack with_actuator(const StackInput &input, const Stack &stack, const StackActuator &actuator, const double value)
{
  Stack changed      = stack;
  const double delta = value - actuator.present;
  each_roll(input, changed, actuator, [&](StackRoll &roll, const bool made) {
    const double up = roll.axis[1] > 0 ? 1 : -1;
    if (actuator.kind == StackActuatorKind::bending)
      for (StackLoad &load : roll.loads)
        load.force[1] += up * delta;
    else if (actuator.kind == StackActuatorKind::shift)
      roll.shift += made && input.settings.lower == LowerHalf::turned ? -delta : delta;
    else if (!made)
      roll.supports[actuator.saddle].motion[1] -= up * delta;
  });
  return changed;
}

// Gauss-Newton in shares of the ranges, (51.20).
StackOptimum optimise_stack(const StackInput &input, const Stack &stack, const MakeStackEngine &make,
                            std::vector<StackActuator> actuators, std::vector<StackTarget> targets)
{
  const Index n = Index(actuators.size()), m = Index(targets.size());
  VectorXd present(n), low(n), high(n);
  for (Index a = 0; a < n; ++a) {
    present[a] = actuators[std::size_t(a)].present;
    low[a]     = actuators[std::size_t(a)].low;
    high[a]    = actuators[std::size_t(a)].high;
  }
  const VectorXd range = high - low;
  VectorXd x           = present.cwiseMax(low).cwiseMin(high);
  StackOptimum optimum;
  SolvedStack solved;
  const auto solve_at = [&](const VectorXd &values) {
    ++optimum.steps;
    solve_from(solved, input, stack_at(input, stack, actuators, values), make);
  };
  solve_at(x);
  for (StackTarget &target : targets)
    target.present = value_of(target.goal, solved.state.strip);
  MatrixXd J(m, n);
  for (int step = 0; step < most_steps; ++step) {
    VectorXd missing(m);
    for (Index t = 0; t < m; ++t)
      missing[t] = targets[std::size_t(t)].wanted - value_of(targets[std::size_t(t)].goal, solved.state.strip);
    for (Index a = 0; a < n; ++a)
      J.col(a) = influences(input, solved, make, actuators[std::size_t(a)], x[a], targets);
    MatrixXd A(m + n, n);
    A << J * range.asDiagonal() / micrometre, least_move * MatrixXd::Identity(n, n);
    VectorXd b(m + n);
    b << missing / micrometre, least_move * (present - x).cwiseQuotient(range);
    VectorXd move = bounded_least_squares(A, b, (low - x).cwiseQuotient(range), (high - x).cwiseQuotient(range));
    if (move.cwiseAbs().maxCoeff() < settled)
      break;
    for (int halving = 0;; ++halving)
      try {  // a step that parts the rolls is too long
        const VectorXd next = (x + range.cwiseProduct(move)).cwiseMax(low).cwiseMin(high);
        solve_at(next);
        x = next;
        break;
      } catch (const SolverError &) {
        if (halving == most_halvings)
          throw;
        move /= 2;
      }
  }
  for (Index a = 0; a < n; ++a) {
    StackActuator &actuator = actuators[std::size_t(a)];
    actuator.optimum        = x[a];
    actuator.influence.assign(J.col(a).data(), J.col(a).data() + m);
    if (x[a] - low[a] < settled * range[a])
      actuator.bound = "lower";
    else if (high[a] - x[a] < settled * range[a])
      actuator.bound = "upper";
  }
  for (StackTarget &target : targets)
    target.reached = value_of(target.goal, solved.state.strip);
  optimum.actuators = std::move(actuators);
  optimum.targets   = std::move(targets);
  return optimum;
}
}  // namespace mill
