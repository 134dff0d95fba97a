// The critical speed followed from second to second: the same as a search of the whole range, 20 times cheaper.
#include "tests/support/film_pass.h"
#include "tests/support/near.h"
#include "tests/support/synthetic_record.h"
#include "twin/chatter/critical_slopes.h"
#include "twin/chatter/critical_track.h"
#include <cmath>

using namespace mill;
using namespace mill::twin;

namespace {
ChatterModel published_stand()
{
  const std::array<double, 6> mass{119e3, 75e3, 9.2e3, 9.2e3, 75e3, 36.5e3};
  const std::array<double, 6> stiffness{6.9e10, 3.0e10, 6.06e10, 6.06e10, 4.4e10, 10.1e10};
  const std::array<double, 6> damping{6.05e5, 4.25e5, 6.05e5, 6.05e5, 4.25e5, 6.05e5};
  ChatterModel model;
  model.stand   = {dynamics::six_mass_structure(mass, stiffness, damping), 4.95, 4.95, 210e9};
  model.bite    = film_pass();
  model.range   = {5, 30};
  model.numbers = dynamics::six_mass_numbers(mass, stiffness, damping);
  return model;
}

dynamics::CriticalSpeed searched(const ChatterModel &model, const bite::RollBite &bite)
{
  return dynamics::critical_speed(model.stand, bite, model.scheme, model.range);
}
}  // namespace

TEST(CriticalTrack, FollowsASweepOfInputs)
{
  const ChatterModel model = published_stand();
  CriticalTrack track(model);
  track.begin(searched(model, model.bite));
  ASSERT_TRUE(track.following());
  const Eigen::VectorXd u = synthetic::uniforms(3, 4 * 60);
  const Strip &s          = model.bite.strip;
  for (int i = 0; i < 60; ++i) {
    // slow swings of everything with steps of a second's size on top: tensions +-20 %, thicknesses +-4 and +-2 %
    const auto swing = [&](const int channel, const double reach, const double step) {
      return 1 + reach * std::sin(0.2 * i * (1 + 0.3 * channel)) + step * (u[4 * i + channel] - 0.5);
    };
    ChatterInputs in;
    in.entry_thickness = s.entry_thickness * swing(0, 0.04, 0.005);
    in.exit_thickness  = s.exit_thickness * swing(1, 0.02, 0.005);
    in.entry_tension   = s.entry_tension * swing(2, 0.2, 0.04);
    in.exit_tension    = s.exit_tension * swing(3, 0.2, 0.04);
    const auto bite    = with_inputs(model.bite, in);
    ASSERT_TRUE(track.follow(bite)) << i << ": " << track.why();
    if (i % 6)
      continue;
    const auto all = searched(model, bite);
    ASSERT_EQ(all.verdict, dynamics::Verdict::crossing);
    EXPECT_TRUE(near(track.point().speed, all.speed, within(1e-6, "asked for"))) << i;
    EXPECT_TRUE(near(track.point().frequency, all.frequency, within(1e-6, "asked for"))) << i;
  }
}

TEST(CriticalTrack, ReportsWhenItIsLost)
{
  const ChatterModel model = published_stand();
  CriticalTrack track(model);
  EXPECT_FALSE(track.following());
  EXPECT_FALSE(track.follow(model.bite));
  EXPECT_EQ(track.why(), "not searched yet");
  track.begin(searched(model, model.bite));
  auto thicker                 = model.bite;
  thicker.strip.exit_thickness = 1.01 * thicker.strip.entry_thickness;
  EXPECT_FALSE(track.follow(thicker)) << "an exit thicker than the entry";
  EXPECT_FALSE(track.why().empty());
  track.begin(searched(model, model.bite));
  auto strong                = model.bite;
  strong.strip.entry_tension = 0;
  strong.strip.exit_tension  = 0;  // no step of a second
  const bool kept            = track.follow(strong);
  const auto all             = searched(model, strong);
  EXPECT_TRUE(!kept || std::abs(track.point().speed / all.speed - 1) < 1e-6) << "right or lost, never wrong";
  ChatterModel narrow = model;
  narrow.range        = {5, 15};
  CriticalTrack none(narrow);
  none.begin(searched(narrow, narrow.bite));
  EXPECT_FALSE(none.following());
  EXPECT_NE(none.why().find("stable from"), std::string::npos) << none.why();
}

TEST(CriticalTrack, IntervalIsThatOfChangedInputs)
{
  const ChatterModel model = published_stand();
  CriticalTrack track(model);
  track.begin(searched(model, model.bite));
  ASSERT_TRUE(track.follow(model.bite));
  // one doubt alone: half the difference of two searches
  for (const char *key : {"condition.entry_tension", "oil.viscosity", "stand.masses[4]", "stand.entry_distance"}) {
    const double d = 0.002;
    const auto one = track.interval(model.bite, {{key, d, true}});
    const auto at  = [&](const double factor) {
      ChatterModel changed = model;
      if (std::string(key) == "condition.entry_tension")
        changed.bite.strip.entry_tension *= factor;
      else if (std::string(key) == "oil.viscosity")
        changed.bite.strip.friction.viscosity *= factor;
      else if (std::string(key) == "stand.entry_distance")
        changed.stand.entry_distance *= factor;
      else
        changed.stand.structure = model.numbers[4].scaled(factor);
      return searched(changed, changed.bite).speed;
    };
    EXPECT_TRUE(
        near(one.streamed, std::abs(std::log(at(1 + d) / at(1 - d))) / 2, within(1e-3, "difference of 0.2 %")))
        << key;
    EXPECT_EQ(one.model, 0);
    EXPECT_TRUE(
        near(one.largest_share, 1, within_absolute(1e-12, "one doubt alone has the whole share, rounding")));
  }
  const auto usual = track.interval(model.bite, usual_doubts());
  EXPECT_GT(usual.model, 0.005);
  EXPECT_LT(usual.model, 0.2);
  EXPECT_TRUE(near(usual.low, track.point().speed * std::exp(-1.96 * std::hypot(usual.streamed, usual.model)),
                   within_absolute(1e-9, "definition, rounding")));
  const double spread = scheme_spread(model, model.bite);
  EXPECT_GT(spread, 0.02) << "frozen friction 17.5, implicit 18.9 m/s";
  EXPECT_LT(spread, 0.08);
}

// Whatever the structure is given by, its masses, springs and dampers are in doubt.
TEST(CriticalTrack, EveryNumberOfAStructureHasAnUncertainty)
{
  LumpedModel chain;
  for (std::size_t i = 0; i < chain.M.size(); ++i)
    chain.M[i].value = 1e4;
  for (std::size_t i = 0; i < chain.K.size(); ++i)
    chain.K[i].value = 1e10;
  DynamicsSettings settings;
  settings.modal_damping = 0.02;
  settings.force_meaning = ForceMeaning::measured;
  auto numbers           = published_stand().numbers;
  for (const auto &number : dynamics::chain_numbers(chain, settings))
    numbers.push_back(number);
  ASSERT_EQ(numbers.size(), 19u + 13u);
  for (const auto &number : numbers)
    EXPECT_EQ(doubt_of(usual_doubts(), number.key) != nullptr, number.key != "stand.dampings")
        << number.key << ": those together are each of them already";
}
