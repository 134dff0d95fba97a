// When the samples of a record were taken: step, gaps.
#include "dynamics/response/record_times.h"
#include <gtest/gtest.h>

using namespace mill;

TEST(RecordTimes, OfAnEvenRecord)
{
  const auto r = dynamics::record_times(Eigen::VectorXd::LinSpaced(101, 2, 3));
  EXPECT_EQ(r.samples, 101);
  EXPECT_DOUBLE_EQ(r.duration, 1);
  EXPECT_NEAR(r.step, 0.01, 1e-15);
  EXPECT_EQ(r.n_gaps, 0);
}

// Two samples lost at 0.3 s, five at 0.6 s; times rounded to a tenth of a step elsewhere.
TEST(RecordTimes, FindsTheGaps)
{
  Eigen::VectorXd time(94);
  Eigen::Index n = 0;
  for (int i = 0; i <= 100; ++i)
    if (i != 31 && i != 32 && !(i > 60 && i < 66))
      time[n++] = 0.01 * i + (i % 2 ? 0.001 : 0);
  const auto r = dynamics::record_times(time.head(n));
  EXPECT_EQ(n, 94);
  EXPECT_EQ(r.n_gaps, 2);
  EXPECT_NEAR(r.longest_gap, 0.06, 1e-12);
  EXPECT_NEAR(r.longest_at, 0.6, 1e-12);
  EXPECT_NEAR(r.step, 0.01, 0.0011);
}
