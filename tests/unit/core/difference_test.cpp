#include "core/numerics/difference.h"
#include "tests/support/near.h"
#include <cmath>
#include <limits>

using namespace mill;

namespace {
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
}

TEST(Difference, IsRelativeToTheValueThatIsJudged)
{
  EXPECT_TRUE(near(difference(1.02, 1), 0.02, within(1e-13, "rounding")));
  EXPECT_TRUE(near(difference(3, 4), 0.25, within(1e-13, "rounding")));
}

TEST(Difference, WidensAnErrorAndNeverNarrowsIt)
{
  EXPECT_TRUE(near(widened(0.01, 1.02, 1), 0.02, within(1e-13, "rounding")));
  EXPECT_EQ(widened(0.05, 1.02, 1), 0.05);
  EXPECT_EQ(widened(0.05, unknown, 1), 0.05) << "a second answer that was not computed";
  EXPECT_TRUE(near(widened(unknown, 1.02, 1), 0.02, within(1e-13, "no error before: that of the second answer")));
  EXPECT_TRUE(std::isnan(widened(unknown, unknown, 1)));
}
