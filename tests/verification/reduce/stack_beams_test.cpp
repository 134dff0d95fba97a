#include "core/base/errors.h"
#include "core/model/roller_bearing.h"
#include "core/model/stack_statics.h"
#include "reduce/bearing/rigid_rings.h"
#include "reduce/stack/beam_stack.h"
#include "reduce/stack/stations.h"
#include "tests/support/near.h"
#include "tests/support/reference_stack.h"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <stdexcept>

using namespace mill;
using namespace mill::reduce;

namespace {
constexpr double um = 1e-6, mm = 1e-3, kN = 1e3;

Reference entry_of(const std::string &name)
{
  return reference(name, "stack");
}

Stack stack_of(const std::string &name)
{
  Stack stack = reference_stack(entry_of(name));
  if (name == "four-high.wedge")
    stack.strip.entry_profile = {{-0.5, -20 * um}, {0.5, 20 * um}};
  return stack;
}

BeamStackSettings settings_of(const std::string &name)
{
  BeamStackSettings settings;
  if (entry_of(name)["input"]["strip"]["flattening"].get<std::string>() == "local")
    settings.flattening = Flattening::local;
  return settings;
}

struct Solved {
  Stack stack;
  BeamStack engine;
  StackState state;
  explicit Solved(const std::string &name)
      : stack(stack_of(name)), engine(stack, settings_of(name)), state(engine.solve())
  {
  }
};

// Line load at a place of the mill frame, by a straight line between Gauss points.
double load_at(const PairState &pair, const double z)
{
  const auto next = std::upper_bound(pair.z.begin(), pair.z.end(), z);
  const auto i    = std::clamp<Eigen::Index>(next - pair.z.begin(), 1, pair.z.size() - 1);
  const double t  = (z - pair.z[i - 1]) / (pair.z[i] - pair.z[i - 1]);
  return (1 - t) * pair.load[i - 1] + t * pair.load[i];
}

class StackEntry : public testing::TestWithParam<const char *> {};
}  // namespace

TEST_P(StackEntry, AgreesWithTheIndependentModel)
{
  const std::string name = GetParam();
  const Solved solved(name);
  const Reference result  = entry_of(name)["result"];
  const auto gap          = within(0.003, "mesh error of the reference below 0.15 % of the crown", 50 * um);
  const StripState &strip = solved.state.strip;
  EXPECT_TRUE(near(strip.middle, mm * double(result["h_minus_S_mm"]), within(1e-3, "mesh of the flattening")));
  EXPECT_TRUE(near(strip.crown, um * double(result["crown_um"]), gap));
  EXPECT_TRUE(near(strip.edge_drop, um * double(result["edge_drop_um"]), gap));
  EXPECT_TRUE(near(strip.wedge, um * double(result["wedge_um"]), gap));
  const Reference tangent = result["tangent"];
  EXPECT_TRUE(near(solved.state.modulus.mid, 1e3 * double(tangent["mid_N_per_mm"]),
                   within(2e-3, "ends of open contacts lie within an element")));
  EXPECT_TRUE(near(solved.state.modulus.mean, 1e3 * double(tangent["mean_N_per_mm"]),
                   within(2e-3, "ends of open contacts lie within an element")));
  std::size_t compared = 0;
  for (std::size_t c = 0; c < solved.stack.contacts.size(); ++c) {
    const StackContact &contact = solved.stack.contacts[c];
    const PairState &pair       = solved.state.pairs[c];
    const std::string names     = solved.stack.rolls[contact.a].name + "-" + solved.stack.rolls[contact.b].name;
    if (!result["contacts"].contains(names))
      continue;  // the reference lists the upper half of a stack that is the same on both sides
    const Reference written = result["contacts"][names];
    ++compared;
    EXPECT_TRUE(
        near(pair.force, written["F_N"], within(3e-8, "statics; positions of the reference have nine digits")));
    EXPECT_TRUE(near(pair.load_centre, mm * double(written["centre_of_load_mm"]),
                     within(1e-6, "statics in a column; deflections of a millimetre turn no line of force", 1)));
    EXPECT_TRUE(near(pair.touching, written["touching_share"], within_absolute(0.005, "one element")));
    const double most = 1e3 * double(written["q_max_N_per_mm"]);
    EXPECT_TRUE(near(pair.peak_load, most, within(7e-3, "peak at the end of a taper, within an element")));
    if (written.contains("q_N_per_mm"))
      for (int i = 0; i < int(written["q_N_per_mm"]["z_mm"].size()); ++i)
        EXPECT_TRUE(near(load_at(pair, mm * double(written["q_N_per_mm"]["z_mm"][i])),
                         1e3 * double(written["q_N_per_mm"]["value"][i]),
                         within(7e-3, "mesh error of the reference below 0.6 %", most)))
            << name << " contact " << c << " place " << i;
  }
  EXPECT_GE(2 * compared, solved.stack.contacts.size());
  if (result.contains("frequencies_Hz")) {
    const Eigen::VectorXd f = solved.engine.frequencies(6);
    for (int i = 0; i < 6; ++i)
      EXPECT_TRUE(near(f[i], result["frequencies_Hz"][i], within(3e-3, "mesh of both models")));
  }
}

INSTANTIATE_TEST_SUITE_P(All, StackEntry,
                         testing::Values("two-high", "four-high", "four-high.local", "four-high.bend",
                                         "four-high.crown", "four-high.offset", "four-high.gap", "four-high.wedge",
                                         "four-high.plain", "six-high", "six-high.wb", "six-high.ib",
                                         "six-high.shift", "six-high.all", "six-high.cvc", "six-high.cvc-",
                                         "six-high.tension", "twenty-high", "twenty-high.asu", "twenty-high.taper",
                                         "twenty-high.tension"),
                         [](const auto &entry) {
                           std::string name = entry.param;
                           for (char &c : name)
                             c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
                           return name + (name == "six_high_cvc_" ? "minus" : "");
                         });

TEST(StackBeams, ForcesOfTheTwentyHighFollowFromItsAngles)
{
  const Solved solved("twenty-high");
  const Reference over_force = entry_of("twenty-high")["resultants_over_F"];
  int compared               = 0;
  for (std::size_t c = 0; c < solved.stack.contacts.size(); ++c) {
    const StackContact &contact = solved.stack.contacts[c];
    const std::string pair      = solved.stack.rolls[contact.a].name + "-" + solved.stack.rolls[contact.b].name;
    if (!over_force.contains(pair))
      continue;
    EXPECT_TRUE(near(solved.state.pairs[c].force / solved.stack.strip.force, over_force[pair],
                     within(3e-8, "statics; positions of the reference have nine digits")))
        << pair;
    ++compared;
  }
  EXPECT_EQ(compared, 12);
}

TEST(StackBeams, ResultantsFollowFromStaticsAlone)
{
  for (const char *name :
       {"four-high.bend", "six-high.all", "six-high.cvc", "twenty-high.asu", "twenty-high.taper"}) {
    const Solved solved(name);
    const auto resultants = stack_resultants(solved.stack, solved.stack.strip.force);
    for (std::size_t c = 0; c < resultants.size(); ++c) {
      const PairState &pair = solved.state.pairs[c];
      EXPECT_TRUE(near(pair.force, resultants[c].force, within(1e-9, "no elasticity in it"))) << name << ' ' << c;
      EXPECT_TRUE(near(pair.load_centre, resultants[c].centre,
                       within(1e-9, "no elasticity in it", solved.stack.strip.width)))
          << name << ' ' << c;
    }
  }
}

// A strip off the middle: the backup rolls carry the strip's load where it is, and it is not even.
TEST(StackBeams, APairCarriesTheStripWhereItIs)
{
  const Solved solved("four-high.offset");
  const StripState &strip      = solved.state.strip;
  const Eigen::VectorXd length = strip.edges.tail(strip.load.size()) - strip.edges.head(strip.load.size()),
                        z      = 0.5 * (strip.edges.tail(strip.load.size()) + strip.edges.head(strip.load.size()));
  const double centre =
      solved.stack.strip.offset + z.cwiseProduct(length).dot(strip.load) / length.dot(strip.load);
  EXPECT_GT(std::abs(centre - solved.stack.strip.offset), 0.1 * mm) << "the wedge moves the load";
  for (const PairState &pair : solved.state.pairs)
    EXPECT_TRUE(near(pair.load_centre, centre, within(1e-9, "no elasticity in it", solved.stack.strip.width)));
}

TEST(StackBeams, DerivativesAgreeWithTheReference)
{
  const Reference slopes = entry_of("influence")["result"];
  const auto reason      = within(1e-3, "central differences of the reference and its mesh");
  Solved four("four-high");
  const auto parabola = [](const double z) { return -0.5 * std::pow(2 * z / 1.4, 2); };
  const auto bending  = [&](const Solved &of, const std::size_t upper, const std::size_t lower, const double z) {
    return of.engine.influence_of_loads(upper, {{-z, {0, 1}}, {z, {0, 1}}}).crown +
           of.engine.influence_of_loads(lower, {{-z, {0, -1}}, {z, {0, -1}}}).crown;
  };
  const auto of_crown = [&](const std::size_t upper, const std::size_t lower) {
    return four.engine.influence_of_radius(upper, parabola).crown +
           four.engine.influence_of_radius(lower, parabola).crown;
  };
  const auto per = [&](const char *name) { return double(slopes[name]); };
  EXPECT_TRUE(near(four.engine.influence_of_force().crown, per("four-high: d/dF um per kN") * um / kN, reason));
  EXPECT_TRUE(near(bending(four, four.stack.upper, four.stack.lower, 1.0),
                   per("four-high: d/d bending um per kN") * um / kN, reason));
  EXPECT_TRUE(
      near(of_crown(four.stack.upper, four.stack.lower), per("four-high: d/d work-roll crown um per um"), reason));
  EXPECT_TRUE(near(of_crown(four.stack.contacts[0].b, four.stack.contacts[1].b),
                   per("four-high: d/d backup crown um per um"), reason));
  const Solved six("six-high.all");
  EXPECT_TRUE(near(bending(six, six.stack.upper, six.stack.lower, 1.1),
                   per("six-high.all: d/d wb um per kN") * um / kN, reason));
}

// Differences of the fourth order: (8 (c1 - c-1) - (c2 - c-2)) / 12 step.
TEST(StackBeams, DerivativesAreThoseOfItsOwnSolutions)
{
  const auto compare = [](const std::string &name, const double step, const Tolerance &tolerance) {
    Solved solved(name);
    const auto slope = [&](const std::function<void(Stack &, double)> &change, const double h) {
      const auto crown = [&](const double times) {
        Stack stack = stack_of(name);
        change(stack, times * h);
        return BeamStack(stack, settings_of(name)).solve().strip.crown;
      };
      return (8 * (crown(1) - crown(-1)) - (crown(2) - crown(-2))) / (12 * h);
    };
    const std::size_t roll = solved.stack.upper, backup = solved.stack.contacts[0].b;
    EXPECT_TRUE(near(solved.engine.influence_of_force().crown,
                     slope([](Stack &s, const double more) { s.strip.force += more; }, step), tolerance))
        << name;
    EXPECT_TRUE(near(solved.engine.influence_of_loads(roll, {{-1, {0, 1}}, {1, {0, 1}}}).crown,
                     slope(
                         [&](Stack &s, const double more) {
                           for (const double z : {-1., 1.})
                             s.rolls[roll].loads.push_back({z, {0, more}});
                         },
                         step / 2),
                     tolerance))
        << name;
    for (const std::size_t of : {roll, backup}) {
      const double length = solved.stack.rolls[of].length;
      EXPECT_TRUE(near(
          solved.engine.influence_of_radius(of, [&](const double z) { return -0.5 * std::pow(2 * z / length, 2); })
              .crown,
          slope([&](Stack &s, const double more) { s.rolls[of].profile.crown += more; }, step * 5e-11), tolerance))
          << name << ' ' << solved.stack.rolls[of].name;
    }
  };
  compare("four-high", 10 * kN, within(1e-6, "fifth derivative, away from changes of contact"));
  compare("four-high.bend", 10 * kN, within(1e-6, "fifth derivative, away from changes of contact"));
  // A contact that is partly open: a Gauss point that opens within the step bends the curve.
  // Its crowns have a rounding of 1e-17 to 4e-17 m, which smaller steps show; at 80 N some points open.
  compare("four-high.crown", 40, within(1e-6, "no Gauss point opens within the step"));
}

TEST(StackBeams, AMirroredStackHasTheMirroredState)
{
  const auto middle_crown = [](Stack stack, const double turn, const double lift) {
    for (StackRoll &roll : stack.rolls) {
      roll.shift *= turn;
      roll.axis[0] *= turn;
      roll.turned = turn < 0;
      for (auto &section : roll.sections)
        section = {std::min(turn * section.from, turn * section.to),
                   std::max(turn * section.from, turn * section.to), section.diameter};
      for (auto &support : roll.supports)
        support.z *= turn;
      for (auto &load : roll.loads)
        load.z *= turn;
      roll.axis[1] += lift;
    }
    stack.strip.offset *= turn;
    return BeamStack(stack).solve().strip;
  };
  for (const char *name : {"four-high.offset", "six-high.cvc"}) {
    const StripState as_drawn = middle_crown(stack_of(name), 1, 0), turned = middle_crown(stack_of(name), -1, 0),
                     lifted = middle_crown(stack_of(name), 1, 0.3);
    const auto rounding     = within(1e-8, "Newton's last step", 10 * um);
    EXPECT_TRUE(near(turned.crown, as_drawn.crown, rounding)) << name;
    EXPECT_TRUE(near(turned.wedge, -as_drawn.wedge, rounding)) << name;
    EXPECT_TRUE(near(lifted.crown, as_drawn.crown, rounding)) << name;
  }
}

// A flattening that each place has for itself loses a quarter of the edge drop.
TEST(StackBeams, NeighboursFlattenTheRollAtTheEdgeToo)
{
  const Solved half_space("four-high"), local("four-high.local");
  EXPECT_LT(local.state.strip.edge_drop, 0.8 * half_space.state.strip.edge_drop);
  EXPECT_TRUE(near(local.state.strip.middle, half_space.state.strip.middle,
                   within(1e-3, "both laws are one in the middle of a long load")));
}

TEST(StripFlattening, ALongUniformLoadReturnsThePlaneLaw)
{
  FlattenedRoll roll;
  roll.edges         = Eigen::VectorXd::LinSpaced(401, -20, 20);
  roll.radius        = 0.2;
  roll.arc           = 0.02;
  roll.law           = Flattening::local;
  const double plane = flattening_between(roll, -0.05, 0.05).sum();
  roll.law           = Flattening::half_space;
  EXPECT_TRUE(near(flattening_between(roll, -0.05, 0.05).sum(), plane,
                   within(1e-4, "a load a hundred radii long is not infinite")));
}

TEST(StackBeams, ARollThatNothingHoldsIsNamed)
{
  Stack stack = stack_of("four-high");
  stack.rolls[stack.contacts[0].b].supports.clear();
  try {
    BeamStack(stack).solve();
    FAIL() << "a stack without support was solved";
  } catch (const SolverError &error) {
    EXPECT_NE(std::string(error.what()).find("singular"), std::string::npos) << error.what();
  }
}

TEST(StackBeams, AForceBeyondTheEndOfItsRollIsRefused)
{
  for (const double side : {-1., 1.}) {
    Stack stack = stack_of("four-high");
    stack.rolls[stack.upper].loads.push_back({side * 5, {0, kN}});  // the roll is 2.32 m long
    EXPECT_THROW(BeamStack(stack, {}), std::logic_error) << side;
  }
}

// Rolls do not change their diameter with the strip: away from it a bent roll needs no element shorter than a
// thirtieth of the diameter.
TEST(StackStations, ANarrowStripLeavesTheRollsTheirElements)
{
  Stack stack           = stack_of("four-high");
  double length         = 0;
  const double thinnest = stack.rolls[stack.upper].diameter;
  for (const StackRoll &roll : stack.rolls)
    length = std::max(length, roll.sections.back().to - roll.sections.front().from);
  for (const double width : {0.2, 0.06, 0.01, 0.001}) {
    stack.strip.width       = width;
    const double longest    = width / 60;
    const Stations stations = stations_of(stack, longest);
    // Graded by a fifth from 0.15 of the longest: n elements reach 1.2^n times as far.
    const double graded = std::log(length / (0.15 * longest)) / std::log(1.2), drawn = 40;
    EXPECT_LT(double(stations.z.size()), length / (thinnest / 30) + 2 * graded + 80 + drawn) << width;
    for (int e = 0; e + 1 < int(stations.z.size()); ++e) {
      const double middle = (stations.z[std::size_t(e)] + stations.z[std::size_t(e) + 1]) / 2;
      const bool on_strip = std::abs(middle) < width / 2;
      ASSERT_LE(stations.length(e), (1 + 1e-9) * (on_strip ? longest : std::max(longest, thinnest / 30)))
          << middle;
    }
  }
}

TEST(StackBeams, ElementsAwayFromANarrowStripAreShortEnough)
{
  Stack stack            = stack_of("four-high");
  stack.strip.width      = 0.1;
  stack.strip.crown_at   = 0.02;
  stack.strip.edge_drop  = {0.04, 0.02};
  BeamStackSettings fine = settings_of("four-high");
  fine.elements_per_width *= 2;
  BeamStack usual(stack, settings_of("four-high")), twice(stack, fine);
  const StackState state = usual.solve(), finer = twice.solve();
  EXPECT_TRUE(near(state.pairs[0].force, stack.strip.force, within(1e-9, "statics")));
  EXPECT_TRUE(near(state.strip.middle, finer.strip.middle, within(1e-3, "error of the mesh")));
  EXPECT_TRUE(
      near(state.strip.crown, finer.strip.crown, within(1e-2, "error of the mesh at the edges of the strip")));
  EXPECT_TRUE(near(state.pairs[0].peak_load, finer.pairs[0].peak_load, within(1e-3, "error of the mesh")));
}

// Two drawings may differ by micrometres; an element that short is as stiff as a rigid body.
TEST(StackBeams, SolveBarrelsWhoseEndsDifferByMicrometres)
{
  const Solved as_drawn("four-high");
  for (const double more : {2e-6, 1e-5, 1e-4}) {
    Stack stack = stack_of("four-high");
    for (StackRoll &roll : stack.rolls)
      if (roll.name[0] == 'B')
        roll.length += more;
    BeamStack engine(stack, {});
    const StackState state = engine.solve();
    EXPECT_TRUE(near(state.strip.crown, as_drawn.state.strip.crown,
                     within(1e-4, "a barrel that is longer by less than 1e-4 of its length")))
        << more;
    EXPECT_TRUE(near(state.pairs[0].force, stack.strip.force, within(1e-9, "statics"))) << more;
  }
}

// Both chocks of a column move together: the gap opens by what its bearings and their housings give way.
TEST(StackBeams, ABearingIsASpringThatTouchesItsCurveAtItsLoad)
{
  RollerBearing crb;
  crb.type            = BearingType::four_row_cylindrical;
  crb.rollers_per_row = 32;
  crb.roller_length   = 0.11;
  crb.roller_law      = OneRollerLaw::palmgren;
  BearingCurve curve;
  for (double load = 50 * kN; load < 3000 * kN; load *= 1.25) {
    const bearing::BearingState state = bearing::solve_bearing(crb, load);
    curve.load.push_back(load);
    curve.approach.push_back(state.displacement);
    curve.tangent.push_back(state.tangent);
  }
  const double housing = 2500 * kN / mm;
  Stack rigid          = stack_of("four-high");
  for (StackRoll &roll : rigid.rolls)
    for (StackSupport &support : roll.supports)
      support.stiffness = {0, 1e15};
  Stack held = rigid;
  for (StackRoll &roll : held.rolls)
    for (StackSupport &support : roll.supports) {
      support.bearing = "crb";
      support.housing = housing;
      support.curve   = std::make_shared<const BearingCurve>(curve);
    }
  const bearing::BearingState at = bearing::solve_bearing(crb, rigid.strip.force / 2);
  const StackState stiff = BeamStack(rigid).solve(), soft = BeamStack(held).solve();
  EXPECT_TRUE(near(soft.strip.middle - stiff.strip.middle, 2 * (at.displacement + rigid.strip.force / 2 / housing),
                   within(1e-5, "cubic between loads that are 1.25 times apart; 1 nm of the rigid supports")));
  EXPECT_TRUE(near(1 / soft.modulus.mid - 1 / stiff.modulus.mid, 1 / at.tangent + 1 / housing,
                   within(1e-4, "slope of that cubic")));
  EXPECT_TRUE(near(soft.strip.crown, stiff.strip.crown, within(1e-8, "even motion", 10 * um)));
}
