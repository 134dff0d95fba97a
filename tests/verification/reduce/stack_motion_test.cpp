#include "reduce/stack/beam_stack.h"
#include "reduce/stack/group_modes.h"
#include "reduce/stack/moving_stack.h"
#include "reduce/stack/section_forces.h"
#include "reduce/stack/stack_mode_names.h"
#include "reduce/stack/strip_side.h"
#include "reduce/stand/stand_modes.h"
#include "tests/support/near.h"
#include "tests/support/reference_stack.h"
#include <gtest/gtest.h>

using namespace mill;
using namespace mill::reduce;

namespace {
struct Moved {
  Stack stack;
  BeamStack engine;
  StackState state;
  MovingStack moving;
  explicit Moved(Stack of, const int elements = 30)
      : stack(std::move(of)), engine(stack, {elements}), state(engine.solve()), moving(moving_stack(engine))
  {
  }
  explicit Moved(const std::string &name, const int elements = 30)
      : Moved(reference_stack(reference(name, "stack")), elements)
  {
  }
};

class StackInMotion : public testing::TestWithParam<const char *> {};
}  // namespace

TEST_P(StackInMotion, HasTheFrequenciesOfTheIndependentModel)
{
  const std::string name = GetParam();
  const Moved moved(name);
  const auto modes = stand_modes(moved.moving.model);
  // Of the four-high the reference lists them with local flattening, which no frequency feels.
  const Reference list =
      reference(name == "four-high" ? "four-high.local" : name, "stack")["result"]["frequencies_Hz"];
  ASSERT_GE(list.size(), 6u);
  for (std::size_t i = 0; i < list.size(); ++i)
    EXPECT_TRUE(near(modes.frequency[Eigen::Index(i)], double(list[i]), within(3e-3, "mesh of both models"))) << i;
}

// The static shape of each roll is one of its unknowns, so that nothing of the gap's compliance is lost.
TEST_P(StackInMotion, OpensUnderAForceAsTheBeamsDo)
{
  const Moved moved(GetParam());
  const BeamStackParts parts = moved.engine.parts();
  double of_beams            = 0;
  for (const StripSide &side : parts.sides) {
    const Eigen::VectorXd q = parts.load / moved.stack.strip.force;
    of_beams += q.dot(side.integrals(side.respond(Eigen::VectorXd::Zero(side.group.size()), q)));
  }
  const StandModel &model = moved.moving.model;
  EXPECT_TRUE(near(model.b.dot(static_displacement(model)), of_beams, within(1e-7, "rounding of a stiff stand")));
}

// What the supports above the strip take up of a slow force is the force.
TEST_P(StackInMotion, PassesAStaticForceOnToItsLoadCell)
{
  const Moved moved(GetParam());
  const StandModel &model = moved.moving.model;
  EXPECT_TRUE(near(model.load_cell.dot(static_displacement(model)), 1,
                   within(1e-6, "equilibrium; deflections of a millimetre turn no line of force")));
}

TEST_P(StackInMotion, HasTheMassOfItsRollsAndChocks)
{
  const Moved moved(GetParam());
  double of_beams = 0, of_lumps = lumped_stack(moved.engine, moved.state).model.M.trace();
  for (const RollGroup &group : moved.engine.parts().groups)
    for (std::size_t r = 0; r < moved.stack.rolls.size(); ++r)
      if (group.holds(r)) {
        const auto beam         = group.free_beam(r);
        Eigen::VectorXd upwards = Eigen::VectorXd::Zero(beam.mass.rows());
        for (Eigen::Index i = 0; i < upwards.size(); i += 2)
          upwards[i] = 1;
        of_beams += double(group.planes().size()) * upwards.dot(beam.mass * upwards);
      }
  EXPECT_TRUE(near(of_lumps, of_beams, within(1e-9, "the same sections")));
}

INSTANTIATE_TEST_SUITE_P(All, StackInMotion, testing::Values("two-high", "four-high", "six-high", "twenty-high"),
                         [](const auto &entry) {
                           std::string name = entry.param;
                           for (char &c : name)
                             c = c == '-' ? '_' : c;
                           return name;
                         });

TEST(StackMotion, LumpedFourHighIsTwoMassesAHalf)
{
  const Moved moved("four-high");
  const MovingStack lumped = lumped_stack(moved.engine, moved.state);
  const auto modes         = stand_modes(lumped.model);
  const StackContact &pair = moved.stack.contacts[0];
  const double bearings    = 2 * moved.stack.rolls[pair.b].supports[0].stiffness[1],
               contact     = moved.state.pairs[0].uniform_tangent;
  const auto a_row = Eigen::Index(pair.a), b_row = Eigen::Index(pair.b);
  const double backup = lumped.model.M(b_row, b_row), work = lumped.model.M(a_row, a_row);
  const double a = (bearings + contact) / backup, c = contact / work;
  for (const double sign : {-1., 1.}) {
    const double square =
        (a + c) / 2 + sign * std::sqrt((a - c) * (a - c) / 4 + contact * contact / (backup * work));
    const double f = std::sqrt(square) / (2 * M_PI);
    EXPECT_TRUE(near((modes.frequency.array() - f).abs().minCoeff(), 0, within_absolute(1e-9 * f, "closed form")));
  }
}

// The load grows where it presses most, so that the weighted tangent lies above the even one at a crowned load.
TEST(StackMotion, TangentOfAPairIsTheChangeBetweenTwoForces)
{
  Stack stack = reference_stack(reference("four-high", "stack"));
  const Moved moved(stack);
  const double step = 1e-3 * stack.strip.force;
  std::array<double, 2> force{}, approach{};
  for (const int side : {0, 1}) {
    Stack other = stack;
    other.strip.force += (side ? 1 : -1) * step;
    BeamStack engine(other, {30});
    const StackState state      = engine.solve();
    const PairState &pair       = state.pairs[0];
    force[std::size_t(side)]    = pair.force;
    approach[std::size_t(side)] = pair.weight.dot(pair.load.cwiseProduct(pair.approach)) / pair.force;
  }
  EXPECT_TRUE(near(moved.state.pairs[0].loaded_tangent, (force[1] - force[0]) / (approach[1] - approach[0]),
                   within(1e-5, "central difference over 0.2 % of the force")));
}

// (51.21) by hand: two places of 1 m with 1 and 2 N/m, 1 Pa each, so that their approaches are 1 and 2 m.
TEST(StackMotion, APairHasATangentWhereItsPlacesMoveAlike)
{
  PairState pair;
  pair.weight = pair.tangent = Eigen::Vector2d(1, 1);
  pair.load = pair.approach = Eigen::Vector2d(1, 2);
  // The mean approach is sum q^2 / sum q, 5/3; both loads larger by the share x: it is larger by x, too.
  EXPECT_TRUE(near(loaded_tangent(pair, pair.load), 3 / (5. / 3), within(1e-14, "rounding")));
  // One more newton on both: sum q^2 changes by 2 (1 + 2), sum q by 2, the mean by 6/3 - 5 * 2/9 = 8/9.
  EXPECT_TRUE(near(loaded_tangent(pair, Eigen::Vector2d(1, 1)), 2 / (8. / 9), within(1e-14, "rounding")));
  // The smaller load grows at the cost of the larger one: sum q^2 by 2 (3 - 4), sum q by 1. More force, and the
  // mean approach is less.
  EXPECT_TRUE(std::isnan(loaded_tangent(pair, Eigen::Vector2d(3, -2))));
}

namespace {
// Work rolls of the four-high bent by `times` the 100 kN per chock of its reference.
Stack bent_four_high(const double times)
{
  Stack stack = reference_stack(reference("four-high.bend", "stack"));
  for (StackRoll &roll : stack.rolls)
    for (StackLoad &load : roll.loads)
      load.force[1] *= times;
  return stack;
}
}  // namespace

// A lumped stack is the stack of beams in which no roll tilts or bends: the stiffness of its translations alone.
TEST_P(StackInMotion, LumpedIsTheStackWhoseRollsOnlyTranslate)
{
  const Moved moved(GetParam());
  const MovingStack lumped = lumped_stack(moved.engine, moved.state);
  Eigen::MatrixXd moves    = Eigen::MatrixXd::Zero(Eigen::Index(moved.moving.moved.size()), lumped.model.M.rows());
  for (std::size_t i = 0; i < moved.moving.moved.size(); ++i)
    for (std::size_t k = 0; k < lumped.moved.size(); ++k) {
      const MovedRoll &full = moved.moving.moved[i], &one = lumped.moved[k];
      if (full.motion == MovedRoll::Motion::translation && full.roll == one.roll && full.axis == one.axis)
        moves(Eigen::Index(i), Eigen::Index(k)) = std::sqrt(lumped.model.M(Eigen::Index(k), Eigen::Index(k)));
    }
  const Eigen::MatrixXd restricted = moves.transpose() * stiffness_of(moved.moving.model) * moves,
                        of_lumps   = stiffness_of(lumped.model);
  EXPECT_TRUE(near((restricted - of_lumps).cwiseAbs().maxCoeff(), 0,
                   within_absolute(1e-8 * of_lumps.cwiseAbs().maxCoeff(), "rounding of shapes of a free beam")));
}

// Bending that carries much of a contact: the force then relieves its loaded ends and loads its middle. Fewer
// freedoms cannot lower the lowest frequency (Rayleigh).
TEST(StackMotion, LumpedStackIsHeldUnderBendingOfItsWorkRolls)
{
  for (const double times : {0., 4., 6., 8., 10., 12., 15., 20.}) {
    const Moved moved(bent_four_high(times));
    const MovingStack lumped = lumped_stack(moved.engine, moved.state);
    EXPECT_GT(stand_modes(lumped.model).frequency[0], stand_modes(moved.moving.model).frequency[0]) << times;
    for (const PairState &pair : moved.state.pairs)
      EXPECT_FALSE(pair.loaded_tangent <= 0) << times;
  }
}

TEST(StackMotion, StripBetweenTheRollsMovesOnlyModesThatOpenTheGap)
{
  const Moved moved("six-high");
  const auto open = stand_modes(moved.moving.model), rolling = stand_modes(with_strip(moved.moving));
  const auto named =
      gap_mode_names(gap_motions(moved.stack, moved.state, moved.moving, with_strip(moved.moving), rolling));
  EXPECT_GT(moved.moving.strip_stiffness, 0);
  // Mirror halves: up and down together the gap stays, and so does the frequency.
  EXPECT_TRUE(near(rolling.frequency[0], open.frequency[0], within(1e-9, "the strip is not strained")));
  const int gap = gap_mode(gap_motions(moved.stack, moved.state, moved.moving, with_strip(moved.moving), rolling));
  ASSERT_GE(gap, 0);
  EXPECT_GT(rolling.frequency[gap], 1.2 * open.frequency[0]);
  EXPECT_EQ(named[std::size_t(gap)].key, "gap_first_kind");
}

// A stiffer strip cannot lower a frequency (Rayleigh), and none rises beyond the next one of the open stack.
TEST(StackMotion, FrequenciesOfTheRollingStateAreAboveThoseOfTheOpenOne)
{
  const Moved moved("four-high");
  const auto open = stand_modes(moved.moving.model), rolling = stand_modes(with_strip(moved.moving));
  for (Eigen::Index k = 0; k < open.frequency.size(); ++k)
    EXPECT_GE(rolling.frequency[k], open.frequency[k] * (1 - 1e-9));
}

// A roll on two bearings under an even load over the width: F/2 (span/2 - width/4) in the middle.
TEST(StackSections, CarryTheMomentOfAnEvenLoad)
{
  Stack stack         = reference_stack(reference("two-high", "stack"));
  stack.strip.modulus = stack.strip.entry_modulus = stack.strip.tension_modulus = 0;
  BeamStack engine(stack, {30});
  const StackState state = engine.solve();
  const StackRoll &roll  = stack.rolls[stack.upper];
  const double span      = std::abs(roll.supports[1].z - roll.supports[0].z);
  const double moment    = stack.strip.force / 2 * (span / 2 - stack.strip.width / 4);
  const SectionForces of = section_forces(stack, state, stack.upper);
  EXPECT_TRUE(near(of.moment.col(1).cwiseAbs().maxCoeff(), moment, within(1e-9, "statics")));
  EXPECT_TRUE(near(of.shear.col(1).cwiseAbs().maxCoeff(), stack.strip.force / 2, within(1e-9, "statics")));
  EXPECT_TRUE(near(of.moment.col(0).cwiseAbs().maxCoeff(), 0, within_absolute(1e-9 * moment, "no force along x")));
  EXPECT_GE(largest_bending_stress(stack, state, stack.upper),
            32 * moment / (M_PI * std::pow(roll.diameter, 3)) * (1 - 1e-9));
}
