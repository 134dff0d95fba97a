#include "tests/support/live_samples.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

using namespace mill;

namespace {
live::TwinModel stand_of_r3()
{
  const ParameterSet set = parameter_set("R3");
  return {"test", "as published", set.stand, set.dynamics, "hash"};
}

Eigen::VectorXd waves_of_force(const Eigen::Index n)
{
  return Eigen::VectorXd::LinSpaced(n, 0, 0.3 * double(n - 1)).array().sin() * 5e3 + 976e3;
}
}  // namespace

// Samples that were refused or dropped are no time that did not pass: the twin stands still behind them as behind
// a gap, and its samples keep their numbers.
TEST(LiveLosses, ARefusedOrDroppedBlockIsAGap)
{
  for (const bool dropped : {false, true}) {
    LiveSamples run(stand_of_r3(), 1000);
    run.send(waves_of_force(1000), 100);
    if (dropped)
      run.engine().take(live::DroppedBlock{1000, 400});
    else
      run.engine().take(live::RefusedLine{"line 12: no JSON", 1000, 400});
    run.send(waves_of_force(1000), 100, 1400);
    int gaps = 0;
    for (const live::LiveBlock &block : run.blocks)
      if (block.after_gap && ++gaps == 2) {
        EXPECT_EQ(block.first, 1400);
        EXPECT_EQ(block.simulated.row(0).cwiseAbs().maxCoeff(), 0) << "equilibrium";
      }
    EXPECT_EQ(gaps, 2) << dropped;
    EXPECT_EQ(run.blocks.back().first + run.blocks.back().force.size(), 2400);
    EXPECT_EQ(run.messages.back(), "gap: 400 samples before s = 1400 are missing");
    EXPECT_TRUE(run.engine().book()->balanced());
    EXPECT_EQ(run.engine().book()->channels()[0].missing, 0);
  }
}

// A source of another rate keeps the account of the channels; where its numbers begin, its first samples say, also
// when they are lost.
TEST(LiveLosses, ASourceMayBeginWithALoss)
{
  for (const bool dropped : {false, true}) {
    LiveSamples run(stand_of_r3(), 1000);
    run.send(waves_of_force(1000), 100);
    run.engine().take(live::SourceHead{2000, {}, "test", {{"force", "N"}}, {1}});
    if (dropped)
      run.engine().take(live::DroppedBlock{100, 50});
    else
      run.engine().take(live::RefusedLine{"unknown channel \"torque\"", 100, 50});
    run.send(waves_of_force(1000), 100, 150);
    const live::ChannelAccount &account = run.engine().book()->channels()[0];
    EXPECT_EQ(account.offered, 2050);
    EXPECT_EQ(account.processed, 2000);
    EXPECT_EQ(account.missing, 0);
    EXPECT_EQ(dropped ? account.overrun : account.rejected, 50);
    EXPECT_TRUE(run.engine().book()->balanced());
    const auto state = run.engine().state();
    EXPECT_EQ(LiveSamples(stand_of_r3(), 2000, &state).messages.at(0), "goes on at s = 1150 of source \"test\"");
  }
}

// Two heads before any block: the second begins the source, since numbers below zero are of no sample.
TEST(LiveLosses, BeforeTheFirstSampleAnotherStartIsAnotherSource)
{
  const double ten = 1767607200;  // s since 1970
  for (const double second : {ten - 3600, ten, ten + 3600}) {
    LiveSamples run(stand_of_r3(), 1000);
    for (const double start : {ten, second})
      run.engine().take(live::SourceHead{1000, start, "dated", {{"force", "N"}, {"speed", "m/s"}}, {1, 1}});
    const Eigen::MatrixXd values = waves_of_force(400).replicate(1, 2);
    run.engine().take(live::SourceBlock{0, values});
    run.engine().flush();
    ASSERT_FALSE(run.blocks.empty());
    EXPECT_EQ(run.blocks.front().first, 0);
    EXPECT_EQ(run.engine().source()->start_time, second);
    EXPECT_EQ(run.engine().book()->channels()[0].offered, 400);
    run.engine().take(live::SourceHead{1000, second - 0.1, "dated", {{"force", "N"}, {"speed", "m/s"}}, {1, 1}});
    run.engine().take(live::SourceBlock{500, values});
    EXPECT_EQ(run.engine().book()->next(), 800) << "behind a sample it goes on: 500 of it is 400 of the source";
  }
}

TEST(LiveLosses, TwoRefusedSamplesAreDrawnAcross)
{
  const Eigen::VectorXd force = waves_of_force(1002);
  LiveSamples run(stand_of_r3(), 1000);
  run.send(force.head(500), 100);
  run.engine().take(live::RefusedLine{"mill.csv:502:1: no number", 500, 2});
  run.send(force.tail(500), 100, 502);
  ASSERT_EQ(run.simulated().rows(), 1002);
  std::int64_t next = 0;
  for (const live::LiveBlock &block : run.blocks) {
    EXPECT_EQ(block.first, next);
    next = block.first + block.force.size();
    if (block.first == 500)
      EXPECT_TRUE(near(block.force[0], force[499] + (force[502] - force[499]) / 3,
                       within_absolute(1e-6, "straight line between two samples, rounding of the force in N")));
  }
  EXPECT_EQ(run.engine().book()->channels()[0].rejected, 2);
}

// 9.91e37 is what instruments send for "not a number" (SCPI); the largest number of a double is as little a force.
TEST(LiveLosses, AnImpossibleValueIsMissing)
{
  for (const double impossible : {9.91e37, -9.91e37, std::numeric_limits<double>::max()}) {
    Eigen::VectorXd force = waves_of_force(1002), straight = force;
    force[500]    = impossible;
    straight[500] = 0.5 * (force[499] + force[501]);
    LiveSamples run(stand_of_r3(), 1000), whole(stand_of_r3(), 1000);
    run.send(force, 100);
    whole.send(straight, 100);
    ASSERT_EQ(run.simulated().rows(), 1002);
    EXPECT_LT((run.simulated() - whole.simulated()).cwiseAbs().maxCoeff(),
              1e-12 * whole.simulated().cwiseAbs().maxCoeff());
    EXPECT_EQ(run.engine().book()->channels()[0].missing, 1);
    EXPECT_EQ(run.engine().book()->channels()[0].processed, 1001);
    EXPECT_EQ(std::count_if(run.messages.begin(), run.messages.end(),
                            [](const std::string &text) {
                              return text.rfind("note: channel \"force\" is ", 0) == 0 &&
                                     text.find(" at s = 500: ") != std::string::npos;
                            }),
              1);
  }
}
