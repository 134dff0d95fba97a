#include "core/model/case.h"
#include "dynamics/cluster/stack_of_case.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modes.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include <chrono>
#include <gtest/gtest.h>

using namespace mill;

namespace {
// The six masses of a stand one above the other, each a roll of the mass of its body; the bite is the spring of
// the strip, which carries nothing at rest.
ClusterStand six_masses_as_rolls(const LumpedModel &chain)
{
  ClusterStand stand;
  stand.stack.gravity         = false;
  stand.stack.strip           = "M3-M4";
  stand.stack.strip_stiffness = chain.K[3].value;
  double y                    = 3;
  for (std::size_t i = 0; i < 6; ++i) {
    ClusterRoll roll;
    roll.name            = "M" + std::to_string(i + 1);
    roll.barrel_diameter = 1;
    roll.barrel_length   = 1;
    roll.mass            = chain.M[i].value;
    roll.position        = {0, y};
    y -= i == 2 ? 1.001 : 1;
    stand.rolls.push_back(roll);
    ClusterSupport guide;
    guide.roll      = roll.name;
    guide.name      = roll.name + "_guide";
    guide.type      = SupportType::guide;
    guide.stiffness = 1e12;
    stand.supports.push_back(guide);
  }
  const auto spring = [&](const char *pair, const double k) {
    ClusterContact c;
    c.pair      = pair;
    c.law       = ClusterLaw::spring;
    c.stiffness = k;
    stand.contacts.push_back(c);
  };
  spring("M1-M2", chain.K[1].value);
  spring("M2-M3", chain.K[2].value);
  spring("M4-M5", chain.K[4].value);
  spring("M5-M6", chain.K[5].value);
  for (const auto &[roll, k] : {std::pair{"M1", chain.K[0].value}, std::pair{"M6", chain.K[6].value}}) {
    ClusterSupport ground;
    ground.roll      = roll;
    ground.type      = SupportType::guide;
    ground.direction = M_PI / 2;
    ground.stiffness = k;
    stand.supports.push_back(ground);
  }
  return stand;
}
}  // namespace

TEST(OtherStacks, AFourHighHasTheVerticalFrequenciesOfItsChain)
{
  const LumpedModel chain  = published_stand();
  const ClusterStand stand = six_masses_as_rolls(chain);
  const auto state         = cluster::pass_state(stand, {}, 1e6);
  const auto expected =
      dynamics::modes(dynamics::mill_model(chain, settings(ForceMeaning::disturbance, 0))).frequency;
  std::vector<double> vertical;
  for (const cluster::Mode &mode : state.modes) {
    double up = 0;
    for (std::size_t k = 1; k < mode.kinetic.size(); k += 2)
      up += mode.kinetic[k].value;
    if (up > 0.5)
      vertical.push_back(mode.frequency);
  }
  ASSERT_EQ(vertical.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_TRUE(near(vertical[i], expected[Eigen::Index(i)], within(1e-10, "the same matrices"))) << i;
}

TEST(OtherStacks, LoadsOfATwentyHighFollowItsAngles)
{
  const Case the_case       = read_case("cases/twenty-high.toml");
  const ClusterStand &stand = *std::get<ClusterCase>(the_case.spec).stand;
  ClusterStand weightless   = stand;
  weightless.stack.gravity  = false;
  const double force        = 1.2e3;  // small: the angles are those of the unloaded stack
  const auto state          = cluster::pass_state(weightless, stand.schedule[0], force);
  // Resultants from angles alone, force over rolling force.
  const std::map<std::string, double> statics{{"S-O", 0.684501}, {"O-I", 0.624983}, {"O-J", 0.260558},
                                              {"I-A", 0.585182}, {"I-B", 0.152394}, {"J-B", 0.340871}};
  for (std::size_t i = 0; i < state.stack.contacts.size(); ++i)
    if (const auto match = statics.find(state.stack.contacts[i].name); match != statics.end())
      EXPECT_TRUE(
          near(state.rest.contact_loads[i] / force, match->second,
               within(2e-5, "six digits, places of the backing shafts rounded to 0.1 mm, approaches of 0.1 um")))
          << match->first;
  EXPECT_TRUE(state.rest.stable());
  EXPECT_TRUE(cluster::free_motions(state.stack).empty());
}

TEST(OtherStacks, TwentyRollsTakeMilliseconds)
{
  const Case the_case       = read_case("cases/twenty-high.toml");
  const ClusterStand &stand = *std::get<ClusterCase>(the_case.spec).stand;
  double best               = 1;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    const auto state = cluster::pass_state(stand, stand.schedule[0], 1.2e6);
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    ASSERT_EQ(state.modes.size(), 40u);
  }
  EXPECT_LT(best, 0.1) << "20 ms alone on a machine; here tests run side by side";
}

TEST(OtherStacks, ContactsAtRestAreThoseOfRollsThatTurnFreely)
{
  const Case the_case = read_case("cases/z-mill.toml");
  ClusterStand stand  = *std::get<ClusterCase>(the_case.spec).stand;
  const auto free     = cluster::pass_state(stand, stand.schedule[0], 1148e3);
  stand.stack.spin    = ClusterSpin::coupled;
  const auto coupled  = cluster::pass_state(stand, stand.schedule[0], 1148e3);
  const auto approach = [](const cluster::PassState &s, const std::size_t i) {
    return cluster::contact_state(s.stack, s.stack.contacts[i], s.rest.u).approach;
  };
  for (std::size_t i = 0; i < free.stack.contacts.size(); ++i)
    EXPECT_TRUE(near(approach(coupled, i), approach(free, i), within(1e-12, "nothing turns at rest")))
        << free.stack.contacts[i].name;
}

TEST(OtherStacks, WithCoupledSpinTheRollsTurnTogetherFreely)
{
  const Case the_case = read_case("cases/z-mill.toml");
  ClusterStand stand  = *std::get<ClusterCase>(the_case.spec).stand;
  const auto free     = cluster::pass_state(stand, stand.schedule[0], 1148e3);
  stand.stack.spin    = ClusterSpin::coupled;
  const auto coupled  = cluster::pass_state(stand, stand.schedule[0], 1148e3);
  ASSERT_EQ(coupled.modes.size(), 15u);
  // Four contacts without a ring join five spins: one is left free.
  EXPECT_LT(std::abs(coupled.modes[0].frequency), 1e-2);
  EXPECT_GT(coupled.modes[1].frequency, 100);
  // On the vertical line no contact slips in a vertical motion: those modes stay, except for the control rolls
  // next to it.
  const auto vertical = [&](const cluster::PassState &s, const std::size_t i) {
    return s.modes[std::size_t(s.identity[i])].frequency;
  };
  EXPECT_TRUE(near(vertical(coupled, 0), vertical(free, 0), within(1e-2, "control rolls slip on W")));
}

TEST(OtherStacks, TwoHalvesWithCoupledSpinDoNotBuckle)
{
  const Case the_case         = read_case("cases/six-high.toml");
  ClusterStand stand          = *std::get<ClusterCase>(the_case.spec).stand;
  const double force          = 8e6;
  stand.stack.strip_stiffness = 5e9;
  const auto free             = cluster::pass_state(stand, stand.schedule[0], force);
  stand.stack.spin            = ClusterSpin::coupled;
  const auto coupled          = cluster::pass_state(stand, stand.schedule[0], force);
  EXPECT_TRUE(near(coupled.rest.least_root, free.rest.least_root, within(1e-12, "nothing turns at rest", 1)));
}
