#include "core/base/errors.h"
#include "tests/support/live_samples.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include <gtest/gtest.h>
#include <limits>

using namespace mill;

namespace {
constexpr double none = std::numeric_limits<double>::quiet_NaN();

live::TwinModel published()
{
  const ParameterSet set = parameter_set("R3");
  return {"test", "as published", set.stand, set.dynamics, "hash"};
}

Eigen::VectorXd steps_of_force(const Eigen::Index n)
{
  Eigen::VectorXd force(n);
  for (Eigen::Index i = 0; i < n; ++i)
    force[i] = 976e3 + 5e3 * std::sin(0.3 * double(i)) + double(i % 7) * 100;
  return force;
}

Eigen::Index settling_rows(const LiveSamples &run)
{
  Eigen::Index n = 0;
  for (const auto &block : run.blocks)
    n += block.settling ? block.simulated.rows() : 0;
  return n;
}
}  // namespace

// Two missing samples of force are drawn across, by null or by number; blocks of any length give the same.
TEST(LiveGaps, TwoMissingSamplesAreDrawnAcross)
{
  Eigen::VectorXd straight = steps_of_force(4000), holes = straight;
  straight[1000] = (2 * straight[999] + straight[1002]) / 3;
  straight[1001] = (straight[999] + 2 * straight[1002]) / 3;
  holes[1000] = holes[1001] = none;
  LiveSamples whole(published(), 10000);
  whole.send(straight, 4000);
  const double peak = whole.simulated().cwiseAbs().maxCoeff();
  for (const Eigen::Index length : {1, 3, 500, 1001, 4000}) {
    LiveSamples run(published(), 10000);
    run.send(holes, length);
    ASSERT_EQ(run.simulated().rows(), 4000) << length;
    EXPECT_LT((run.simulated() - whole.simulated()).cwiseAbs().maxCoeff(), 1e-12 * peak) << length;
    EXPECT_EQ(run.engine().book()->channels()[0].missing, 2);
  }
  LiveSamples numbered(published(), 10000);
  numbered.send(straight.head(1000), 100);
  numbered.send(straight.tail(2998), 100, 1002);
  ASSERT_EQ(numbered.simulated().rows(), 4000);
  EXPECT_LT((numbered.simulated() - whole.simulated()).cwiseAbs().maxCoeff(), 1e-12 * peak);
  EXPECT_EQ(numbered.engine().book()->channels()[0].missing, 2);
}

// Behind a longer gap the twin stands in equilibrium and settles, however the blocks are cut.
TEST(LiveGaps, ALongerGapSettlesAgain)
{
  const double rate     = 2000;
  const auto settles    = Eigen::Index(std::llround(live::settling_time(live::stepped(published(), {})) * rate));
  Eigen::VectorXd force = steps_of_force(6 * settles);
  force.segment(3 * settles, 3).setConstant(none);
  for (const Eigen::Index length : {1, 2, 999, 8192}) {
    LiveSamples run(published(), rate);
    run.send(force, length);
    ASSERT_EQ(run.simulated().rows(), force.size() - 3) << length;
    EXPECT_EQ(settling_rows(run), 2 * settles) << length;
    int gaps = 0;
    for (const auto &block : run.blocks)
      if (block.after_gap) {
        ++gaps;
        EXPECT_EQ(block.first, gaps == 1 ? 0 : 3 * settles + 3);
        EXPECT_EQ(block.simulated.row(0).cwiseAbs().maxCoeff(), 0) << "equilibrium";
      }
    EXPECT_EQ(gaps, 2) << length;
  }
}

TEST(LiveGaps, SettlingLastsFiveTimesTheSlowestDecay)
{
  // 1 % and 39 Hz: 5 / (0.01 2 pi 39) = 2 s; here 3 % of the published stand, by its own first frequency
  const double time = live::settling_time(live::stepped(published(), {}));
  live::Tuning half;
  half.damping = 0.5;
  EXPECT_TRUE(near(live::settling_time(live::stepped(published(), half)) / time, 2,
                   within_absolute(1e-9, "half the damping decays half as fast, rounding")));
}

TEST(LiveGaps, AStandWithoutDampingIsRefused)
{
  auto model                   = published();
  model.dynamics.modal_damping = 0;
  try {
    LiveSamples run(model, 1000);
    FAIL() << "an undamped twin was taken";
  } catch (const InputError &error) {
    EXPECT_EQ(error.problems.front().message,
              "millstand live: the case has no damping, so that the twin would never forget how it started; give "
              "dynamics.modal_damping, for example --set dynamics.modal_damping=\"1 %\"");
  }
}

TEST(LiveGaps, NumbersThatBeginAgainAreANewRecord)
{
  LiveSamples run(published(), 1000);
  run.send(steps_of_force(1000), 100, 500000);
  run.engine().take(live::SourceHead{1000, {}, "test", {{"force", "N"}}, {1}});
  run.send(steps_of_force(1000), 100, 0);
  EXPECT_EQ(run.engine().book()->channels()[0].processed, 2000);
  EXPECT_EQ(run.engine().book()->channels()[0].missing, 0);
  EXPECT_EQ(run.engine().book()->doubled(), 0);
}

TEST(LiveGaps, ASecondRecordOfTheSameClockCountsWhatIsBetween)
{
  LiveSamples run(published(), 1000);
  run.engine().take(live::SourceHead{1000, 1000.0, "a", {{"force", "N"}}, {1}});
  run.send(steps_of_force(1000), 100, 0);
  run.engine().take(live::SourceHead{1000, 1004.0, "b", {{"force", "N"}}, {1}});
  run.send(steps_of_force(1000), 100, 0);
  EXPECT_EQ(run.engine().book()->channels()[0].offered, 5000);
  EXPECT_EQ(run.engine().book()->channels()[0].missing, 3000);
}

// A source whose clock was set back sends what was there already: after a minute of it one message says so.
TEST(LiveGaps, ReportsAMinuteThatComesAgain)
{
  LiveSamples run(published(), 100);
  run.engine().take(live::SourceHead{100, 1000.0, "a", {{"force", "N"}}, {1}});
  run.send(steps_of_force(20000), 100, 0);
  run.engine().take(live::SourceHead{100, 900.0, "a", {{"force", "N"}}, {1}});
  run.messages.clear();
  run.send(steps_of_force(15000), 100, 10000);
  ASSERT_EQ(run.messages.size(), 1u);
  EXPECT_EQ(
      run.messages[0],
      "clock: a minute of samples that were taken already has come again, up to s = 16100 where 30000 is the "
      "next: they count as doubled and move nothing. If the clock of the source was set back, let it send a "
      "head without \"start\", or start the twin with --fresh");
  EXPECT_EQ(run.engine().book()->doubled(), 15000);
}

TEST(LiveGaps, StateOfAnotherCaseIsNotTaken)
{
  LiveSamples first(published(), 1000);
  first.send(steps_of_force(100), 10);
  const auto state = first.engine().state();
  auto other       = published();
  other.hash       = "another";
  LiveSamples second(other, 1000, &state);
  EXPECT_EQ(
      second.messages.front(),
      "the stored state belongs to another case, or to other values of this one; the twin starts without it");
  EXPECT_EQ(second.engine().resumed_at(), 0);
}
