// Detection with its stated errors: 2 000 seeded records of 4 s to 10 min, 1 to 50 kHz and 1 to 4 channels, in
// white and coloured noise; lines, modes, impacts, modulation; and 500 with growth.  MILLSTAND_RECORDS sets
// another number.
#include "tests/support/detection_score.h"
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>

TEST(DetectionCampaign, KeepsItsStatedErrors)
{
  const char *number = std::getenv("MILLSTAND_RECORDS");
  const long records = number ? std::atol(number) : 2000;
  detection_score::Score score, growth;
  for (long seed = 1; seed <= records; ++seed)
    score.add(detection_score::score_of(std::uint64_t(seed), {}));
  random_record::Wish growing;
  growing.growth = true;
  growing.lines = growing.impacts = false;
  for (long seed = 1; seed <= records / 4; ++seed)
    growth.add(detection_score::score_of(std::uint64_t(100000 + seed), growing));
  std::printf("%s%s%s", score.table().c_str(), growth.table().c_str(), (score.missed + growth.missed).c_str());
  EXPECT_GE(double(score.lines_found), 0.995 * double(score.lines));
  EXPECT_LE(20 * score.false_lines, score.records);
  EXPECT_GE(double(score.modes_found), 0.97 * double(score.modes));
  EXPECT_LE(1000 * score.false_growth, score.calm);
  EXPECT_GE(double(growth.growth_found), 0.99 * double(growth.growing));
  EXPECT_LT(std::max(score.account_error, growth.account_error), 1e-3);
  EXPECT_EQ(score.fateless + growth.fateless, 0);
}
