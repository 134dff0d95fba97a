// Numbers in sentences and on the console: a number has the digits that its error allows.
#include "core/base/short_number.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;

TEST(KnownDigits, TheLastDigitIsWhereTheErrorBegins)
{
  EXPECT_EQ(number_within(60.3838, 0.64), "60");
  EXPECT_EQ(number_within(60.3838, 0.1), "60");
  EXPECT_EQ(number_within(60.3838, 0.01), "60.4");
  EXPECT_EQ(number_within(60.3838, 0.001), "60.38");
  EXPECT_EQ(number_within(39948.2, 0.004), "39950")
      << "an error of 160 begins with a small digit: its second digit";
  EXPECT_EQ(number_within(39948.2, 0.05), "39900") << "an error of 1997 begins with 2: hundreds";
  EXPECT_EQ(number_within(-0.012345, 0.1), "-0.0123");
  EXPECT_EQ(number_within(0.5, 3), "0.5") << "one digit at least";
}

TEST(KnownDigits, WithoutAnErrorAllDigitsAreShown)
{
  EXPECT_EQ(number_within(60.3838, std::nan("")), "60.384");
  EXPECT_EQ(number_within(60.3838, 0, 3), "60.4");
  EXPECT_EQ(number_within(4.5, std::nan("")), "4.5") << "zeros at the end say nothing";
  EXPECT_EQ(number_within(0, 0.1), "0");
}

TEST(KnownDigits, RoundingMayReachTheNextDecade)
{
  EXPECT_EQ(number_within(99.96, 0.005), "100.0") << "an error of 0.5: one decimal";
  EXPECT_EQ(number_within(999999, 0.01), "1000000");
}

TEST(KnownDigits, VeryLargeAndVerySmallNumbersHaveAnExponent)
{
  EXPECT_EQ(number_within(4.0192e10, 0.01), "4.02e+10");
  EXPECT_EQ(number_within(1.24e-6, 0.1), "1.24e-06");
  EXPECT_EQ(number_within(std::nan(""), 0.1), "nan");
}

TEST(KnownDigits, ErrorsInPercentHaveTwoDigits)
{
  EXPECT_EQ(percent_text(0.64), "64 %");
  EXPECT_EQ(percent_text(0.00314), "0.31 %");
  EXPECT_EQ(percent_text(1.2), "120 %");
}
