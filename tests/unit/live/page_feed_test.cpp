#include "twin/live/display/page_feed.h"
#include "twin/live/steady_clock.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;

namespace {
live::LiveSource source(const std::string &second_channel, const std::string &unit)
{
  return {"test", 1000, 1767607200.0, {{"force", "N"}, {second_channel, unit}}, {}, {1, 1}};
}

live::LiveBlock block(const double second_channel)
{
  live::LiveBlock block;
  block.rate         = 1000;
  block.force        = Eigen::VectorXd::Constant(4, 1e6);
  block.measured     = Eigen::MatrixXd::Constant(4, 2, second_channel);
  block.simulated    = Eigen::MatrixXd::Zero(4, 0);
  block.displacement = Eigen::VectorXd::Zero(0);
  return block;
}
}  // namespace

// The page draws the distance to the critical speed at the speed of the source that sends now.
TEST(PageFeed, TheSpeedOfASourceEndsWithIt)
{
  live::PageFeed feed;
  feed.begin(source("speed", "m/s"));
  feed.take(block(4.5));
  const auto rolled = feed.numbers(live::steady_now() + 1);
  ASSERT_TRUE(rolled);
  EXPECT_EQ(rolled->speed, 4.5);
  feed.begin(source("upper_work_roll", "m/s2"));
  feed.take(block(0.1));
  const auto next = feed.numbers(live::steady_now() + 2);
  ASSERT_TRUE(next);
  EXPECT_TRUE(std::isnan(next->speed)) << next->speed;
}
