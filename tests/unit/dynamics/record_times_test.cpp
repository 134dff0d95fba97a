// When the samples of a record were taken: step, gaps.
#include "dynamics/response/record_times.h"
#include "tests/support/near.h"
#include <gtest/gtest.h>

using namespace mill;

TEST(RecordTimes, AnEvenRecordHasOneStepAndNoGaps)
{
  const auto r = dynamics::record_times(Eigen::VectorXd::LinSpaced(101, 2, 3));
  EXPECT_EQ(r.samples, 101);
  EXPECT_DOUBLE_EQ(r.duration, 1);
  EXPECT_TRUE(near(r.step, 0.01, within(1e-13, "difference of two times near 3 s: rounding")));
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
  EXPECT_TRUE(near(r.longest_gap, 0.06, within(1e-12 / 0.06, "difference of two times: rounding")));
  EXPECT_TRUE(near(r.longest_at, 0.6, within(1e-12 / 0.6, "a time of the record: rounding")));
  EXPECT_TRUE(near(r.step, 0.01, within(0.11, "a mean over 94 of 101 samples, the gaps not left out")));
}
