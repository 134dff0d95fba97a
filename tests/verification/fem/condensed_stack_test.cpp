#include "core/model/stack_statics.h"
#include "fem/stack/condensed_stack.h"
#include "reduce/stack/beam_stack.h"
#include "tests/support/condensed_reference.h"
#include "tests/support/near.h"
#include "tests/support/reference_stack.h"
#include <cmath>
#include <gtest/gtest.h>

// The engine of condensed rolls against the beams, statics and the independent values of
// tests/reference/stack.json.
using namespace mill;

// Values of docs/theory/51: beams with the shear coefficient of the surface, the exact cylinder at the strip,
// one-sided flattening between the rolls and opposite contacts.
TEST(CondensedStackLong, SolidRollsWithoutShouldersFollowTheirPrediction)
{
  const CondensedReference plain(stack_named("four-high.plain"));
  const reduce::StripState &strip = plain.state.strip;
  EXPECT_TRUE(near(strip.crown, 23.75 * um, within(0.03, "plane cross terms, ends, seats")));
  EXPECT_TRUE(near(strip.edge_drop, 8.16 * um, within(0.04, "plane cross terms, ends, seats")));
  EXPECT_TRUE(near(strip.middle, 0.1006 * mm, within(0.05, "plane cross terms, ends, seats")));
  const reduce::PairState &pair = plain.state.pairs[0];
  EXPECT_TRUE(near(load_between(pair, 0), 871 * 1e3, within(0.02, "plane cross terms, ends, seats")));
  EXPECT_TRUE(near(load_between(pair, 0.95 * 0.7), 447 * 1e3, within(0.04, "plane cross terms, ends, seats")));
}

TEST(CondensedStack, AgreesWithTheBeamsOnAFourHigh)
{
  const Stack four = stack_named("four-high");
  const CondensedReference condensed(four);
  const reduce::StackState beams = reduce::BeamStack(four).solve();
  EXPECT_TRUE(near(condensed.state.strip.crown, beams.strip.crown, within(0.06, "shoulders, cross influence")));
  EXPECT_TRUE(near(condensed.state.modulus.mid, beams.modulus.mid, within(0.05, "shoulders, cross influence")));
  expect_line_loads(condensed, beams);
}

// Rolls as beams are the other engine, with stations, unknowns and solver of this one.
TEST(CondensedStack, WithBeamsForRollsIsTheEngineOfBeams)
{
  for (const char *name : {"two-high", "four-high.offset", "six-high.all", "twenty-high.asu"}) {
    const Stack stack = stack_named(name);
    std::vector<std::shared_ptr<const fem::RollKernel>> kernels;
    for (const StackRoll &roll : stack.rolls)
      kernels.push_back(std::make_shared<const fem::RollKernel>(fem::beam_kernel(roll, 0.01)));
    const reduce::StackState mine  = fem::CondensedStack(stack, kernels, {90}).solve(),
                             beams = reduce::BeamStack(stack).solve();
    const auto mesh                = within(6e-3, "stations of 11 mm, twice as short at the edges", 50 * um);
    EXPECT_TRUE(near(mine.strip.crown, beams.strip.crown, mesh)) << name;
    // The line load of the twenty-high doubles within 25 mm of the edge: 0.32 um here, 0.21 um with stations half
    // as long.
    EXPECT_TRUE(near(mine.strip.edge_drop, beams.strip.edge_drop, within(9e-3, "stations at the edge", 50 * um)))
        << name;
    EXPECT_TRUE(near(mine.strip.wedge, beams.strip.wedge, mesh)) << name;
    EXPECT_TRUE(near(mine.strip.middle, beams.strip.middle, within(1e-3, "stations"))) << name;
    EXPECT_TRUE(near(mine.modulus.mid, beams.modulus.mid, within(1e-3, "stations"))) << name;
    EXPECT_TRUE(near(mine.modulus.mean, beams.modulus.mean, within(1e-3, "stations"))) << name;
    for (std::size_t r = 0; r < stack.rolls.size(); ++r)
      for (std::size_t s = 0; s < beams.rolls[r].reactions.size(); ++s)
        EXPECT_TRUE(near(mine.rolls[r].reactions[s], beams.rolls[r].reactions[s],
                         within(3e-3, "stations", stack.strip.force / 10)))
            << name;
  }
}

namespace {
Stack bent_four_high(const double newton)
{
  Stack stack = stack_named("four-high.bend");
  for (StackRoll &roll : stack.rolls)
    for (StackLoad &load : roll.loads)
      load.force[1] = std::copysign(newton, load.force[1]);
  return stack;
}
}  // namespace

// Half widths beyond 0.03 of the radius: 40 kN/mm on rolls of 210 and 725 mm make one of 8.5 mm.
TEST(CondensedStack, HoldsRollsUnderLoadsThatNeedAWiderContact)
{
  const Stack heavy = bent_four_high(5e6);
  const CondensedReference condensed(heavy, CondensedMesh::coarse);
  const reduce::StackState beams = reduce::BeamStack(heavy).solve();
  const auto resultants          = stack_resultants(heavy, heavy.strip.force);
  for (std::size_t c = 0; c < resultants.size(); ++c)
    EXPECT_TRUE(near(condensed.state.pairs[c].force, resultants[c].force, within(1e-9, "no elasticity in it")));
  EXPECT_GT(beams.pairs[0].peak_load, 30e6);
  EXPECT_TRUE(near(condensed.state.strip.crown, beams.strip.crown, within(0.06, "shoulders, cross influence")));
}

// The widths for which the contacts are summed follow from the loads of the solution, not from those before it.
TEST(CondensedStack, ReturnsToTheStateOfUsualLoadsAfterHeavyOnes)
{
  const Stack usual = bent_four_high(1e5), heavy = bent_four_high(5e6);
  const CondensedReference cold(usual, CondensedMesh::coarse);
  fem::CondensedStack engine(heavy, condensed_rolls(heavy, CondensedMesh::coarse));
  engine.solve();
  ASSERT_TRUE(engine.change(usual));
  const reduce::StackState back = engine.solve();
  EXPECT_TRUE(near(back.strip.middle, cold.state.strip.middle, within(1e-8, "steps of Newton's method end")));
  EXPECT_TRUE(
      near(back.pairs[0].peak_load, cold.state.pairs[0].peak_load, within(1e-8, "steps of Newton's method end")));
}

TEST(CondensedStack, ResultantsFollowFromStaticsAlone)
{
  const Stack six = stack_named("six-high.all");
  const CondensedReference condensed(six, CondensedMesh::coarse);
  const auto resultants = stack_resultants(six, six.strip.force);
  for (std::size_t c = 0; c < resultants.size(); ++c)
    EXPECT_TRUE(near(condensed.state.pairs[c].force, resultants[c].force, within(1e-9, "no elasticity in it")));
  for (std::size_t c = 0; c < six.contacts.size(); ++c)
    if (six.rolls[six.contacts[c].a].name == "I1") {
      EXPECT_TRUE(near(condensed.state.pairs[c].load_centre, 10 * mm, within(1e-9, "no elasticity in it")));
    }
  EXPECT_LT(condensed.state.residual, 1e-12);
}

// Radial displacement of a long solid cylinder at an angle from a line load q cos(k z), over A q, and less that of
// a beam.
TEST(CondensedStack, ContactsOfOneRollFeelEachOther)
{
  const Reference result = reference("evidence.cross-influence", "stack")["result"];
  constexpr double R = 0.1, nu = 0.28, E = 210e9;
  const double A = 2 * (1 - nu * nu) / (M_PI * E), GA = E / (2 * (1 + nu)) * M_PI * R * R;
  for (const double kR : {1., 2.}) {
    const double k = kR / R, length = 4 * M_PI / k;
    Stack alone;
    alone.rolls.resize(1);
    alone.rolls[0].diameter    = 2 * R;
    alone.rolls[0].length      = length;
    alone.rolls[0].sections    = {{-length / 2, length / 2, 2 * R}};
    alone.rolls[0].material    = {E, nu, 7700, not_given};
    const auto solid           = condensed_rolls(alone, CondensedMesh::coarse).front();
    const fem::RollKernel beam = fem::beam_kernel(alone.rolls[0], length / 200);
    // Amplitude of the answer: half the difference of mid-length, a crest, and the trough next to it.
    const auto amplitude = [&](const fem::RollKernel &roll, const Eigen::MatrixXd &flexibility) {
      const Eigen::Index M = roll.edge.size() - 1;
      const auto crest     = [&](const double from, const double to) {  // integral of cos(k z)
        return (std::sin(k * to) - std::sin(k * from)) / k;
      };
      Eigen::VectorXd force(M), share(M);
      for (Eigen::Index i = 0; i < M; ++i) {
        force[i] = crest(roll.edge[i], roll.edge[i + 1]);
        share[i] = force[i] / (roll.edge[i + 1] - roll.edge[i]);
      }
      // Projection on the shape of the load over the middle wave, away from the ends.
      double sum = 0, norm = 0;
      const Eigen::VectorXd u = flexibility * force;
      for (Eigen::Index i = 0; i < M; ++i) {
        const double from = std::max(roll.edge[i], -M_PI / k), to = std::min(roll.edge[i + 1], M_PI / k);
        if (to <= from)
          continue;
        sum += u[i] * share[i] * (to - from);
        norm += share[i] * share[i] * (to - from);
      }
      return sum / norm;
    };
    const Eigen::Index M = solid->edge.size() - 1, N = beam.edge.size() - 1;
    const double shear = (1 / 1.5425 - 1 / 0.886) / (GA * k * k);
    const double order_1 =
        amplitude(*solid, solid->bending.topLeftCorner(M, M)) - amplitude(beam, beam.bending.topLeftCorner(N, N));
    const Reference values = result[kR == 1 ? "kR 1" : "kR 2"];
    for (int i = 0; i < int(result["theta"].size()); ++i) {
      const double theta = double(result["theta"][i]) * M_PI / 180;
      const double u     = std::cos(theta) * (order_1 - shear) + amplitude(*solid, solid->around(theta));
      EXPECT_TRUE(near(u / A, double(values[i]), within_absolute(0.01, "share of A q; ends of the roll")))
          << "kR " << kR << " at " << double(result["theta"][i]) << " degrees";
    }
  }
}

TEST(CondensedStack, ATurnedOrMirroredStackHasTheSameGap)
{
  const auto crowned = [](const double side, const double mirror) {
    Stack stack        = stack_named("twenty-high.taper");
    stack.strip.offset = side * 10 * mm;
    for (StackRoll &roll : stack.rolls) {
      roll.axis[0] *= mirror;
      if (side < 0) {
        roll.turned = !roll.turned;
        roll.shift *= -1;
      }
    }
    return CondensedReference(stack, CondensedMesh::coarse).state.strip;
  };
  const reduce::StripState drawn = crowned(1, 1), turned = crowned(-1, 1), mirrored = crowned(1, -1);
  const auto rounding = within(1e-10, "last step of Newton's method", 50 * um);
  EXPECT_TRUE(near(turned.crown, drawn.crown, rounding));
  EXPECT_TRUE(near(turned.wedge, -drawn.wedge, rounding));
  EXPECT_GT(std::abs(drawn.wedge), 0.1 * um);
  EXPECT_TRUE(near(mirrored.crown, drawn.crown, rounding));
  EXPECT_TRUE(near(mirrored.wedge, drawn.wedge, rounding));
}

// Differences of the fourth order: (8 (c1 - c-1) - (c2 - c-2)) / 12 step.
TEST(CondensedStack, DerivativesAreThoseOfItsOwnSolutions)
{
  const Stack stack  = stack_named("four-high.offset");
  const auto kernels = condensed_rolls(stack, CondensedMesh::coarse);
  fem::CondensedStack engine(stack, kernels);
  const reduce::StackState state = engine.solve();
  const auto exact               = within(1e-6, "fifth derivative over the step, away from changes of contact");
  const auto compare = [&](const reduce::GapShape &shape, const std::function<void(Stack &, double)> &change,
                           const double step) {
    reduce::GapShape slope{};
    slope.opening = 0 * shape.opening;
    for (const auto &[times, weight] :
         {std::pair(1, 8.), std::pair(-1, -8.), std::pair(2, -1.), std::pair(-2, 1.)}) {
      Stack changed = stack;
      change(changed, times * step);
      const reduce::StripState strip = fem::CondensedStack(changed, kernels).solve().strip;
      const double factor            = weight / (12 * step);
      slope.crown += factor * strip.crown;
      slope.edge_drop += factor * strip.edge_drop;
      slope.middle += factor * strip.middle;
      slope.opening += factor * strip.opening;
    }
    EXPECT_TRUE(near(shape.crown, slope.crown, exact));
    EXPECT_TRUE(near(shape.edge_drop, slope.edge_drop, exact));
    EXPECT_TRUE(near(shape.middle, slope.middle, exact));
    EXPECT_LT((shape.opening - slope.opening).norm(), 1e-6 * shape.opening.norm());
    return slope;
  };
  const double slope =
      compare(
          engine.influence_of_force(), [](Stack &s, const double more) { s.strip.force += more; }, 10e3)
          .middle;
  EXPECT_TRUE(near(state.modulus.mid, 1 / slope, exact));
  const std::size_t roll = stack.upper, backup = stack.contacts[0].b;
  compare(
      engine.influence_of_loads(roll, {{-1, {0, 1}}, {1, {0, 1}}}),
      [&](Stack &s, const double step) {
        for (StackLoad &load : s.rolls[roll].loads)
          load.force[1] += step;
      },
      5e3);
  for (const std::size_t of : {roll, backup})
    compare(
        engine.influence_of_radius(of, [](const double z) { return -0.5 * std::pow(2 * z / 1.4, 2); }),
        [&](Stack &s, const double step) { s.rolls[of].profile.crown += step; }, 1e-6);
}

TEST(CondensedStack, ContactsOpenAsThoseOfTheBeams)
{
  for (const char *name : {"four-high.crown", "four-high.gap"}) {
    const Stack stack = stack_named(name);
    const CondensedReference condensed(stack);
    const reduce::StackState beams = reduce::BeamStack(stack).solve();
    EXPECT_TRUE(near(condensed.state.pairs[0].touching, beams.pairs[0].touching,
                     within_absolute(0.03, "two stations of 25 mm in 1400 mm, shoulders")))
        << name;
  }
}

// The next setting starts from the last one and keeps what stays; nothing of that is seen in the state.
TEST(CondensedStack, SettingsInARowAreThoseFromNothing)
{
  for (const char *name : {"six-high.all", "twenty-high.asu"}) {
    const Stack drawn = stack_named(name);
    std::vector<std::shared_ptr<const fem::RollKernel>> kernels;
    for (const StackRoll &roll : drawn.rolls)
      kernels.push_back(std::make_shared<const fem::RollKernel>(fem::beam_kernel(roll, 0.02)));
    fem::CondensedStack in_a_row(drawn, kernels);
    in_a_row.solve();
    Stack stack = drawn;
    for (int i = 0; i < 5; ++i) {
      stack.strip.force *= i == 4 ? 3 : 1.05;
      for (StackRoll &roll : stack.rolls) {
        for (StackLoad &load : roll.loads)
          load.force[1] *= 1.1;
        if (roll.supports.size() > 2)
          roll.supports[2].motion[1] += 2e-5;
      }
      stack.rolls[stack.upper].profile.crown += 2e-5;
      if (i == 2)
        stack.rolls[stack.contacts.front().b].shift += 0.012;
      ASSERT_TRUE(in_a_row.change(stack)) << name;
      const reduce::StackState warm = in_a_row.solve(), cold = fem::CondensedStack(stack, kernels).solve();
      const auto same = within(1e-8, "steps end at 1e-11 of the forces", um);
      EXPECT_TRUE(near(warm.strip.crown, cold.strip.crown, same)) << name << " setting " << i;
      EXPECT_TRUE(near(warm.strip.wedge, cold.strip.wedge, same)) << name << " setting " << i;
      EXPECT_TRUE(near(warm.modulus.mid, cold.modulus.mid, within(1e-6, "factors within 1e-7 of the forces")))
          << name << " setting " << i;
      for (std::size_t c = 0; c < cold.pairs.size(); ++c)
        EXPECT_TRUE(near(warm.pairs[c].peak_load, cold.pairs[c].peak_load, within(1e-8, "the same steps")))
            << name << " setting " << i << " contact " << c;
    }
    stack.strip.width -= 0.1;
    EXPECT_FALSE(in_a_row.change(stack)) << "another strip has other stations";
  }
}
