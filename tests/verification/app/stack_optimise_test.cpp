#include "app/stack/stack_optimise.h"
#include "core/base/errors.h"
#include "core/case/case_file.h"
#include "core/model/case.h"
#include "core/model/stack_input.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <gtest/gtest.h>

// Settings of actuators for a wanted profile, by the engine of beams, which needs nothing condensed.
using namespace mill;

namespace {
constexpr double um = 1e-6, kN = 1e3, mm = 1e-3;
constexpr int elements = 30;

struct Mill {
  Case read;
  const StackInput &input;
  const Stack &stack;
  explicit Mill(const std::string &size)
      : read(read_case(std::string(MILLSTAND_SOURCE_DIR) + "/cases/stack-" + size + "-high.toml")),
        input(*std::get<StackCase>(read.spec).input), stack(*std::get<StackCase>(read.spec).stack)
  {
  }
  StackActuator actuator(const std::string &name, const double low, const double high) const
  {
    StackActuator a = stack_actuator(input, stack, name);
    a.low           = low;
    a.high          = high;
    return a;
  }
  StackOptimum optimum(const std::vector<StackActuator> &actuators, const std::vector<StackTarget> &targets) const
  {
    return optimise_stack(input, stack, beams_of(input, elements), actuators, targets);
  }
  reduce::StripState at(const StackOptimum &optimum) const
  {
    Stack changed = stack;
    for (const StackActuator &a : optimum.actuators)
      changed = with_actuator(input, changed, a, a.optimum);
    return solve_stack(input, changed, beams_of(input, elements)).state.strip;
  }
};
}  // namespace

TEST(StackOptimise, BendingReachesACrown)
{
  const Mill four("four");
  const StackOptimum optimum =
      four.optimum({four.actuator("W.bending_force", -100 * kN, 400 * kN)}, {{StackGoal::crown, 10 * um, 0, 0}});
  EXPECT_TRUE(
      near(four.at(optimum).crown, 10 * um, within_absolute(1e-10, "weight of the smallest move, metres")));
  EXPECT_EQ(optimum.actuators[0].bound, "");
  EXPECT_LE(optimum.steps, 6);
}

TEST(StackOptimise, AnActuatorThatIsTooWeakStopsAtItsBound)
{
  const Mill four("four");
  const StackOptimum optimum =
      four.optimum({four.actuator("W.bending_force", -100 * kN, 50 * kN)}, {{StackGoal::crown, 0, 0, 0}});
  EXPECT_EQ(optimum.actuators[0].bound, "upper");
  EXPECT_DOUBLE_EQ(optimum.actuators[0].optimum, 50 * kN);
  EXPECT_GT(optimum.targets[0].reached, 5 * um);
  EXPECT_TRUE(near(optimum.targets[0].reached, four.at(optimum).crown, within(1e-9, "the same state")));
}

TEST(StackOptimise, FourActuatorsReachCrownAndEdgeDrop)
{
  const Mill six("six");
  const std::vector<StackActuator> actuators{six.actuator("W.bending_force", -200 * kN, 500 * kN),
                                             six.actuator("I.bending_force", -200 * kN, 500 * kN),
                                             six.actuator("I.shift", 0, 200 * mm)};
  const StackOptimum optimum =
      six.optimum(actuators, {{StackGoal::crown, 20 * um, 0, 0}, {StackGoal::edge_drop, 14 * um, 0, 0}});
  const reduce::StripState strip = six.at(optimum);
  EXPECT_TRUE(near(strip.crown, 20 * um, within_absolute(1e-9, "weight of the smallest move, metres")));
  EXPECT_TRUE(near(strip.edge_drop, 14 * um, within_absolute(1e-9, "weight of the smallest move, metres")));
  for (const StackActuator &a : optimum.actuators) {
    EXPECT_GE(a.optimum, a.low);
    EXPECT_LE(a.optimum, a.high);
  }
}

// Backup rolls with 1.2 mm of crown: contacts that are open at the start close on the way.
TEST(StackOptimise, ContactsChangeOnTheWay)
{
  Mill four("four");
  Stack crowned = four.stack;
  for (const StackContact &contact : crowned.contacts)
    crowned.rolls[contact.b].profile.crown = 1.2 * mm;
  const auto touching = [&](const Stack &stack) {
    return solve_stack(four.input, stack, beams_of(four.input, elements)).state.pairs[0].touching;
  };
  StackActuator bending      = four.actuator("W.bending_force", -300 * kN, 300 * kN);
  const double before        = solve_stack(four.input, crowned, beams_of(four.input, elements)).state.strip.crown;
  const StackOptimum optimum = optimise_stack(four.input, crowned, beams_of(four.input, elements), {bending},
                                              {{StackGoal::crown, before + 30 * um, 0, 0}});
  EXPECT_TRUE(
      near(optimum.targets[0].reached, before + 30 * um, within_absolute(1e-9, "weight of the smallest move")));
  const Stack there = with_actuator(four.input, crowned, optimum.actuators[0], optimum.actuators[0].optimum);
  EXPECT_GT(std::abs(touching(there) - touching(crowned)), 0.005);
}

TEST(StackOptimise, WhatIsNoActuatorIsNamed)
{
  const Mill four("four");
  EXPECT_THROW(stack_actuator(four.input, four.stack, "X.shift"), InputError);
  EXPECT_THROW(stack_actuator(four.input, four.stack, "W.diameter"), InputError);
  EXPECT_THROW(stack_actuator(four.input, four.stack, "B.eccentric1"), InputError);
}

TEST(StackOptimiseCommand, PrintsSettingsBoundsAndWhatIsLeft)
{
  const Outcome outcome =
      millstand("stack optimise cases/stack-four-high.toml --target crown=10um --target edge_drop=3um "
                "--bound 'W.bending_force=-100 kN..40 kN' --bound 'W.shift=-1 mm..1 mm' --set engine.model=beams");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char *text : {"crown", "edge_drop", "W.bending_force", "upper", "W.shift", "solutions of the stack"})
    EXPECT_NE(outcome.out.find(text), std::string::npos) << text << "\n" << outcome.out;
  const Outcome refused = millstand("stack optimise cases/stack-four-high.toml --target crown=10kN "
                                    "--bound 'W.bending_force=-100 kN..60 kN'");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("--target crown: \"10kN\" is not a length"), std::string::npos) << refused.err;
}
