// Quantiles against the tables of M. Abramowitz, I. A. Stegun, Handbook of Mathematical Functions (1964), 26.8 and
// 26.10.
#include "core/numerics/quantiles.h"
#include "tests/support/near.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;

TEST(Quantiles, OfChiSquareAreThoseOfTheTable)
{
  EXPECT_TRUE(near(chi_square_above(0.05, 1), 3.84146, within(2e-6, "six digits of the table")));
  EXPECT_TRUE(near(chi_square_above(0.05, 10), 18.3070, within(5e-6, "six digits of the table")));
  EXPECT_TRUE(near(chi_square_above(0.001, 2), 13.816, within(5e-5, "five digits of the table")));
  EXPECT_TRUE(near(chi_square_above(1e-9, 2), 9 * 2 * std::log(10.), within(1e-14, "closed form of two degrees")));
}

TEST(Quantiles, OfStudentsDistributionAreThoseOfTheTable)
{
  EXPECT_TRUE(near(student_above(0.025, 1), 12.706, within(5e-5, "five digits of the table")));
  EXPECT_TRUE(near(student_above(0.025, 11), 2.201, within(3e-4, "four digits of the table")));
  EXPECT_TRUE(near(student_above(0.025, 120), 1.980, within(3e-4, "four digits of the table")));
}
