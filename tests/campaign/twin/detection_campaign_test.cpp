// Detection with its stated errors: 2 000 seeded records of 4 s to 10 min, 1 to 50 kHz and 1 to 4 channels, in
// white and coloured noise; lines, modes, impacts, modulation; and 500 with growth.  MILLSTAND_RECORDS sets
// another number, MILLSTAND_FIRST_SEED another beginning.
#include "tests/support/detection_score.h"
#include <cstdio>
#include <cstdlib>
#include <gtest/gtest.h>

using detection_score::Score;

namespace {
long number_of(const char *variable, const long otherwise)
{
  const char *number = std::getenv(variable);
  return number ? std::atol(number) : otherwise;
}

long number_of_records()
{
  return number_of("MILLSTAND_RECORDS", 2000);
}

// Several processes share the campaign when each begins at another seed.
std::uint64_t first_seed()
{
  return std::uint64_t(number_of("MILLSTAND_FIRST_SEED", 1));
}

Score sum_of(const std::uint64_t first, const long records, const random_record::Wish &wish)
{
  Score sum;
  for (long i = 0; i < records; ++i) {
    const Score one = detection_score::score_of(first + std::uint64_t(i), wish);
    std::printf("%s", one.missed.c_str());  // at once: the campaign takes half an hour
    std::fflush(stdout);
    sum.add(one);
  }
  std::printf("%s", sum.table().c_str());
  EXPECT_LT(sum.account_error, 1e-3);
  EXPECT_EQ(sum.fateless, 0);
  return sum;
}
}  // namespace

TEST(DetectionCampaign, KeepsItsStatedErrors)
{
  const Score score = sum_of(first_seed(), number_of_records(), {});
  EXPECT_GE(double(score.lines_found), 0.995 * double(score.lines));
  EXPECT_LE(20 * score.false_lines, score.records);
  EXPECT_GE(double(score.modes_found), 0.97 * double(score.modes));
  EXPECT_LE(1000 * score.false_growth, score.calm);
}

TEST(DetectionCampaign, FindsGrowthWithItsSign)
{
  random_record::Wish growing;
  growing.growth = true;
  growing.lines = growing.impacts = false;
  const Score score               = sum_of(100000 + first_seed(), number_of_records() / 4, growing);
  EXPECT_GE(double(score.growth_found), 0.99 * double(score.growing));
}
