#pragma once
#include "app/stack/stack_stage.h"
#include "core/base/choice.h"
#include <string>
#include <vector>

// Settings of the actuators of a stack for a wanted profile of the strip.
namespace mill {
constexpr double shift_step = 1e-3;  ///< m, of central differences over a shift, which moves the places of contact

enum class StackActuatorKind { bending, shift, eccentric };
constexpr auto words_of(StackActuatorKind)
{
  return choice_words<StackActuatorKind>("bending_force", "shift", "eccentric");  // a saddle follows the last
}

/// What of the profile is wanted.
enum class StackGoal { crown, edge_drop, wedge };
constexpr auto words_of(StackGoal)
{
  return choice_words<StackGoal>("crown", "edge_drop", "wedge");
}

/// What may be changed, of a listed roll and of the one that is made of it.
struct StackActuator {
  std::string name;  ///< "W.bending_force", "I.shift", "B.eccentric3"
  StackActuatorKind kind = StackActuatorKind::bending;
  std::size_t roll       = 0;       ///< place in StackInput::rolls
  std::size_t saddle     = 0;       ///< of an eccentric, from 0
  double low = 0, high = 0;         ///< SI
  double present = 0, optimum = 0;  ///< SI
  std::vector<double> influence;    ///< of each target per unit of it, at the optimum
  std::string bound;                ///< "lower" or "upper" where it stands at a bound
};

/// m
struct StackTarget {
  StackGoal goal;
  double wanted = 0, present = 0, reached = 0;
};

struct StackOptimum {
  std::vector<StackActuator> actuators;
  std::vector<StackTarget> targets;
  int steps = 0;  ///< solutions of the stack
};

/// An actuator of a case by its name, with its present value.
/// @throws InputError  no such roll or saddle, no chocks to bend it, a shift that a kept condensation does not
/// serve
StackActuator stack_actuator(const StackInput &input, const Stack &stack, const std::string &name);

/// The stack with another value of an actuator.
Stack with_actuator(const StackInput &input, const Stack &stack, const StackActuator &actuator, double value);

/// Least squares of the distances from the targets, bounded, by exact influences at each solved state; contacts
/// open and close on the way.  Of several settings that reach the targets, that with the least share of the
/// ranges. An influence of a shift is a central difference.  theory.md (51.20)
/// @throws SolverError  the stack of the case has no equilibrium; InputError  an unknown target
StackOptimum optimise_stack(const StackInput &input, const Stack &stack, const MakeStackEngine &make,
                            std::vector<StackActuator> actuators, std::vector<StackTarget> targets);
}  // namespace mill
