// A source of accelerations alone: nothing drives the twin, and the vibration is watched all the same.
#include "core/base/errors.h"
#include "tests/support/published_stand.h"
#include "tests/support/synthetic_record.h"
#include "twin/live/compare/comparison.h"
#include "twin/live/engine/engine.h"
#include "twin/live/source/line_session.h"
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace mill;
using namespace mill::live;

namespace {
constexpr double rate = 2000;  // Hz

TwinModel published()
{
  const ParameterSet set = parameter_set("R3");
  return {"test", "as published", set.stand, set.dynamics, "hash"};
}

ComparisonSetup setup_for(const std::vector<LiveChannel> &channels)
{
  const TwinModel model = published();
  ComparisonSetup setup;
  setup.rate     = rate;
  setup.channels = channels;
  setup.places   = places_of(stepped(model, {}));
  setup.chain    = model.chain;
  setup.dynamics = model.dynamics;
  setup.bands    = bands_over("third octave", 125, 240);
  return setup;
}

/// Alarms of noise, in which a vibration grows after 30 s.
std::vector<PageAlarm> alarms_with(const std::vector<LiveChannel> &channels)
{
  Comparison comparison(setup_for(channels));
  std::vector<PageAlarm> begun;
  EngineHooks hooks;
  hooks.observers.push_back([&](const LiveBlock &block) {
    EXPECT_FALSE(block.driven);
    EXPECT_TRUE(std::isnan(block.simulated(0, 0)));
    for (const PageAlarm &alarm : comparison.take(block).alarms)
      if (!alarm.over)
        begun.push_back(alarm);
  });
  Engine engine(published(), hooks);
  engine.take(SourceHead{rate, {}, "test", channels, std::vector<double>(channels.size(), 1)});
  const auto n      = Eigen::Index(36 * rate);
  Eigen::MatrixXd x = synthetic::white(31, n, rate, 0.005);
  for (auto k = Eigen::Index(30 * rate); k < n; ++k) {
    const double t = double(k) / rate;
    x(k, 0) += std::min(5., 0.02 * std::exp(4 * (t - 30))) * std::sin(2 * M_PI * 171.0 * t);
  }
  for (Eigen::Index k = 0; k < n; k += 100)
    engine.take(SourceBlock{k, x.middleRows(k, 100)});
  engine.flush();
  EXPECT_EQ(engine.book()->channels()[0].processed, n);
  return begun;
}
}  // namespace

TEST(UnforcedSource, IsWatchedForChatter)
{
  const auto alarms = alarms_with({{"upper_work_roll", "m/s2"}});
  ASSERT_EQ(alarms.size(), 1u);
  EXPECT_EQ(alarms[0].text.rfind("chatter at 17", 0), 0u) << alarms[0].text;
}

TEST(UnforcedSource, MayHaveChannelsThatAreNoPlaceOfTheModel)
{
  const auto alarms = alarms_with({{"housing_ds", "m/s2"}});
  ASSERT_EQ(alarms.size(), 1u);
  EXPECT_NE(alarms[0].text.find(" Hz, housing_ds: "), std::string::npos) << alarms[0].text;
}

TEST(UnforcedSource, GoesOnAfterARestart)
{
  const SourceHead head{rate, {}, "test", {{"upper_work_roll", "m/s2"}}, {1}};
  const Eigen::MatrixXd x = synthetic::white(32, 4000, rate, 0.005);
  Engine before(published(), {});
  before.take(head);
  before.take(SourceBlock{0, x});
  const auto state = before.state();
  std::vector<LiveBlock> blocks;
  EngineHooks hooks;
  hooks.observers.push_back([&](const LiveBlock &block) { blocks.push_back(block); });
  Engine after(published(), hooks);
  EXPECT_EQ(after.resume(state), "goes on at s = 4000 of source \"test\"");
  after.take(head);
  after.take(SourceBlock{4000, x});
  after.flush();
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].first, 4000);
  EXPECT_FALSE(blocks[0].after_gap);
  EXPECT_FALSE(blocks[0].driven);
  EXPECT_EQ(after.book()->channels()[0].processed, 8000);

  auto of_two_forces = state;
  for (const char *name : {"force", "force"})
    of_two_forces["channels"].push_back(of_two_forces["channels"][0]),
        of_two_forces["channels"].back()["name"] = name;
  EXPECT_EQ(
      Engine(published(), {}).resume(of_two_forces),
      "the stored state cannot be used: it has more than one channel of the force; the twin starts without it");
}

TEST(UnforcedSource, NeedsAForceOrAnAcceleration)
{
  SourceRules rules;
  rules.places = places_of(stepped(published(), {}));
  EXPECT_EQ(known_channels({{"AI_01", "g"}}, rules).channels.at(0).unit, "m/s2");
  try {
    known_channels({{"torque", "Nm"}}, rules);
    FAIL() << "a torque alone is neither";
  } catch (const InputError &error) {
    EXPECT_EQ(
        error.problems.front().message,
        "no channel \"force\", which drives the twin, and no acceleration; name the column of the rolling force "
        "with --channel NAME=force, or give the unit of an acceleration with --unit NAME=g");
  }
}
