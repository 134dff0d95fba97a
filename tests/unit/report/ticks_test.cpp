#include "report/plot/ticks.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill::report;

TEST(Ticks, LinearStepsAreOneTwoOrFive)
{
  for (const double scale : {1e-7, 0.3, 1.0, 42.0, 9.9e5})
    for (const double low : {-1.7, 0.0, 0.93}) {
      const Ticks ticks = linear_ticks(low * scale, (low + 1) * scale, 6);
      ASSERT_GE(ticks.at.size(), 3u);
      EXPECT_LE(ticks.at.size(), 12u);
      const double step     = ticks.at[1] - ticks.at[0];
      const double mantissa = step / std::pow(10.0, std::floor(std::log10(step) + 1e-6));
      EXPECT_TRUE(std::abs(mantissa - 1) < 1e-6 || std::abs(mantissa - 2) < 1e-6 || std::abs(mantissa - 5) < 1e-6)
          << "step " << step;
      EXPECT_GE(ticks.at.front(), low * scale - 1e-9 * scale);
      EXPECT_LE(ticks.at.back(), (low + 1) * scale + 1e-9 * scale);
      EXPECT_EQ(ticks.labels.size(), ticks.at.size());
    }
}

TEST(Ticks, LabelsHaveTheDecimalsOfTheStep)
{
  EXPECT_EQ(linear_ticks(0, 1, 5).labels, (std::vector<std::string>{"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}));
  EXPECT_EQ(linear_ticks(972.8, 979.6, 3).labels, (std::vector<std::string>{"974", "976", "978"}));
  EXPECT_EQ(linear_ticks(-100, 100, 4).labels,
            (std::vector<std::string>{"\u2212100", "\u221250", "0", "50", "100"}));
}

TEST(Ticks, LogarithmicTicksAreAtDecades)
{
  EXPECT_EQ(log_ticks(1, 1000, 6).labels, (std::vector<std::string>{"1", "10", "100", "1000"}));
  EXPECT_EQ(log_ticks(1, 1000, 6).minor.size(), 24u) << "2..9 in three decades";
  EXPECT_EQ(log_ticks(90, 1100, 6).labels, (std::vector<std::string>{"100", "200", "500", "1000"}));
  EXPECT_EQ(log_ticks(1e-6, 1e-3, 6).labels.front(), "10\u207b\u2076");
  EXPECT_LE(log_ticks(1e-12, 1e12, 6).at.size(), 7u) << "a wide range labels only some of its decades";
}

TEST(Ticks, ARangeWithoutDigitsHasNoTicks)
{
  for (const auto &[low, high] : {std::pair(-1e308, 1e308), std::pair(-5e-324, 5e-324), std::pair(1e300, 1e300),
                                  std::pair(1.0, double(NAN)), std::pair(0.0, double(INFINITY))})
    EXPECT_LE(linear_ticks(low, high, 6).at.size(), 20u) << low << " .. " << high;
  EXPECT_TRUE(log_ticks(0, 1, 6).at.empty());
  EXPECT_TRUE(log_ticks(1, INFINITY, 6).at.empty());
  EXPECT_FALSE(log_ticks(1e-300, 1e300, 6).at.empty());
}
