// Roots, least values and borders in one unknown: closed forms, and the number of evaluations that the header
// states.
#include "core/numerics/root_search.h"
#include "tests/support/near.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;

TEST(RootBetween, FindsClosedFormsToTheLastDigits)
{
  int evaluations    = 0;
  const auto counted = [&](const double x) {
    ++evaluations;
    return std::cos(x) - x;
  };
  EXPECT_TRUE(near(root_between(0, 1, counted).value(), 0.739085133215160642, within(1e-15, "rounding")));
  EXPECT_LE(evaluations, 14);
  const auto ratio = [](const double x) { return std::pow(x, 9) - 1e-9; };
  EXPECT_TRUE(near(root_between(1, 1e-3, ratio).value(), 0.1, within(1e-15, "rounding, ends in either order")));
}

TEST(RootBetween, IsNothingWithoutAChangeOfSign)
{
  EXPECT_FALSE(root_between(1, 2, [](const double x) { return x; }));
  EXPECT_FALSE(root_between(-1, 1, [](const double x) { return x < 0 ? NAN : x; }));
  EXPECT_EQ(root_between(0, 2, [](const double x) { return x; }).value(), 0);
}

TEST(RootBetween, EndsAtAJumpAndAtTheWidthThatIsAskedFor)
{
  const auto jump = [](const double x) { return x < 1. / 3 ? -1 : 1e6; };
  EXPECT_TRUE(near(root_between(0, 1, jump).value(), 1. / 3, within(1e-15, "rounding")));
  int evaluations   = 0;
  const double root = root_between(
                          {0, -1}, {1, 1e6}, [&](const double x) { return ++evaluations, jump(x); }, 1e-3)
                          .value();
  EXPECT_TRUE(near(root, 1. / 3, within(1e-3, "the width that was asked for")));
  EXPECT_LE(evaluations, 25);
}

TEST(MinimumBetween, FindsTheLeastValueOfAValley)
{
  const Evaluated least = minimum_between(1e-6, 9e-6, [](const double x) { return x + 4e-12 / x; });
  EXPECT_TRUE(
      near(least.argument, 2e-6, within(1e-7, "the place of a flat minimum, 1e-8 of the interval of 4 places")));
  EXPECT_TRUE(near(least.value, 4e-6, within(1e-14, "rounding")));
}

TEST(BorderBetween, HalvesToNeighbouringNumbersOnBothSides)
{
  const auto property = [](const double x) { return x * x < 2; };
  const Border edge   = border_between(0, 10, property);
  EXPECT_TRUE(property(edge.holds));
  EXPECT_FALSE(property(edge.fails));
  EXPECT_TRUE(near(edge.fails, std::sqrt(2.), within(1e-15, "rounding")));
  int evaluations = 0;
  border_between(
      2, 1, [&](const double x) { return ++evaluations, x > 1.25; }, 1e-3);
  EXPECT_LE(evaluations, 11);
}
