// The short form of the campaign of detection: seeded records with known lines, modes, modulation, impacts and
// growth. The long form, 2 000 records, is tests/campaign/twin/detection_campaign_test.cpp.
#include "tests/support/detection_score.h"
#include <gtest/gtest.h>

using detection_score::score_of;

TEST(DetectionShort, LinesAndModesAreFoundAndNothingElse)
{
  detection_score::Score score;
  random_record::Wish wish;
  wish.most_samples = 1.5e5;
  for (std::uint64_t seed = 1; seed <= 30; ++seed)
    score.add(score_of(seed, wish));
  EXPECT_GE(double(score.lines_found), 0.99 * double(score.lines)) << score.missed;
  EXPECT_LE(score.false_lines, 2) << "one in twenty records, of 30\n" << score.missed;
  EXPECT_GE(double(score.modes_found), 0.93 * double(score.modes)) << score.missed;
  EXPECT_EQ(score.false_growth, 0) << score.missed;
  EXPECT_EQ(score.fateless, 0);
  EXPECT_LT(score.account_error, 1e-3);
}

TEST(DetectionShort, GrowthIsFoundWithItsSign)
{
  detection_score::Score score;
  random_record::Wish wish;
  wish.most_samples = 1e5;
  wish.growth       = true;
  wish.lines = wish.impacts = false;
  for (std::uint64_t seed = 1001; seed <= 1012; ++seed)
    score.add(score_of(seed, wish));
  EXPECT_GE(score.growth_found, score.growing - 1) << score.missed;
}
