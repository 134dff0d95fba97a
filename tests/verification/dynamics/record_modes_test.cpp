// What a record determines: motions, their growth, a limit cycle.
#include "core/base/errors.h"
#include "dynamics/chatter/run.h"
#include "tests/support/near.h"
#include <cmath>
#include <random>

using namespace mill;
using namespace mill::dynamics;
using Eigen::VectorXd;

TEST(RecordModes, FindsThreeMotionsOfWhichTwoAreClose)
{
  const double growth[3] = {-0.03, -0.6, -20}, frequency[3] = {128.1, 121.4, 320}, size[3] = {1, 0.7, 3};
  VectorXd signal = VectorXd::Zero(6001);
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k <= 6000; ++k)
      signal[k] += size[j] * std::exp(growth[j] * 1e-4 * k) * std::cos(2 * M_PI * frequency[j] * 1e-4 * k + j);
  const auto modes = record_modes(signal, 1e-4);
  ASSERT_EQ(modes.size(), 3u);
  for (int j = 0; j < 3; ++j) {
    const RecordMode m = mode_near(modes, frequency[j]);
    EXPECT_TRUE(near(m.growth, growth[j], within(1e-6, "a record without noise")));
    EXPECT_TRUE(near(m.frequency, frequency[j], within(1e-9, "a record without noise")));
    EXPECT_TRUE(near(m.amplitude, size[j], within(1e-5, "a record without noise")));
  }
  EXPECT_TRUE(near(modes[0].frequency, 128.1, within(1e-9, "the strongest at the end comes first")));
}

TEST(RecordModes, WorksWithNoise)
{
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 1e-3);
  VectorXd signal(6001);
  for (int k = 0; k <= 6000; ++k)
    signal[k] = std::exp(0.7e-4 * k) * std::cos(2 * M_PI * 128 * 1e-4 * k) + noise(random);
  const RecordMode m = mode_near(record_modes(signal, 1e-4, 1e-2), 128);
  EXPECT_TRUE(near(m.growth, 0.7, within(0.01, "noise of 1e-3 over 6000 samples: some 1e-3 1/s")));
}

TEST(RecordModes, ReportsRecordsWithoutTheMotion)
{
  EXPECT_TRUE(record_modes(VectorXd::Zero(500), 1e-4).empty());
  EXPECT_TRUE(record_modes(VectorXd::Ones(10), 1e-4).empty());
  try {
    mode_near({{-1, 80, 1}}, 128);
    FAIL() << "a motion 48 Hz away must not pass";
  } catch (const SolverError &e) {
    EXPECT_EQ(e.report.what, "the record has no motion near 128 Hz");
    EXPECT_EQ(e.report.where, "the nearest has 80 Hz");
  }
}

TEST(LimitCycle, DistinguishesASineFromAGrowingOne)
{
  ChatterRun run;
  run.history.time = VectorXd::LinSpaced(5001, 0, 0.5);
  run.history.gap  = 1e-5 * (2 * M_PI * 130 * run.history.time.array() + 0.3).sin();
  run.events       = {{0.1, ChatterChange::entry_slack}, {0.45, ChatterChange::exit_slack}};
  const auto c     = limit_cycle(run);
  EXPECT_TRUE(near(c.amplitude, 1e-5, within(2e-4, "parabola through samples 1/77 of a swing apart")));
  EXPECT_TRUE(near(c.frequency, 130, within(1e-5, "straight line through the level")));
  EXPECT_TRUE(c.settled);
  EXPECT_EQ(c.limits, std::vector<std::string>{"exit strip slack"});
  run.history.gap = run.history.gap.array() * (2 * run.history.time.array()).exp();
  EXPECT_TRUE(near(limit_cycle(run).drift, 2, within(0.01, "windows of ten swings")));
  EXPECT_FALSE(limit_cycle(run).settled);
}
