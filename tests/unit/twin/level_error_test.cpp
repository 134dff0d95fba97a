// The standard error of a level against the scatter of many records.
#include "tests/support/near.h"
#include "tests/support/synthetic_record.h"
#include "twin/spectra/level_error.h"
#include <cmath>

using namespace mill;
using namespace mill::twin;

namespace {
constexpr double rate = 2000;

Waterfall map_of(const Eigen::VectorXd &value)
{
  Fourier fourier;
  return waterfall(value, {{0, value.size()}}, rate, {}, 1024, 400, fourier);
}

double band_power(const Waterfall &map, const double low, const double high)
{
  const double bin = map.rate / double(map.L);
  double power     = 0;
  for (auto k = Eigen::Index(std::ceil(low / bin)); double(k) * bin <= high; ++k)
    power += map.density.row(k).cast<double>().mean();
  return power;
}
}  // namespace

TEST(LevelError, IsTheScatterOfEqualRecords)
{
  constexpr int records = 60;
  double sum = 0, squares = 0, stated = 0;
  for (int i = 0; i < records; ++i) {
    const Waterfall map = map_of(synthetic::white(500 + std::uint64_t(i), 40000, rate, 1));
    const double level  = 0.5 * std::log(band_power(map, 125, 240));
    sum += level;
    squares += level * level;
    stated += level_error(map, 125, 240) / records;
  }
  const double scatter = std::sqrt((squares - sum * sum / records) / (records - 1));
  EXPECT_TRUE(near(stated, scatter, within(0.25, "a deviation of 60 records is known to 9 %, 95 % to 18 %")));
  // 115 Hz for 20 s are 2 300 independent values of power: half of 1/sqrt(2300)
  EXPECT_TRUE(near(stated, 0.5 / std::sqrt(2300.), within(0.25, "of white noise")));
}

TEST(LevelError, OfAModulatedToneIsLargerThanOfASteadyOne)
{
  const Eigen::Index n = 40000;
  const auto tone      = [&](const double depth) {
    return Eigen::VectorXd(Eigen::VectorXd::NullaryExpr(n, [&](const Eigen::Index k) {
      const double t = double(k) / rate;
      return (1 + depth * std::sin(2 * M_PI * 0.11 * t)) * std::sin(2 * M_PI * 180 * t);
    }));
  };
  const double steady = level_error(map_of(tone(0)), 179, 181), slow = level_error(map_of(tone(0.5)), 179, 181);
  EXPECT_LT(steady, 1e-3);
  EXPECT_GT(slow, 0.05) << "two periods of the modulation determine the mean level to some 10 %";
}

TEST(LevelError, NeedsALevelOverTime)
{
  EXPECT_TRUE(std::isnan(level_error(map_of(Eigen::VectorXd::Ones(2048)), 125, 240))) << "three frames";
  EXPECT_TRUE(std::isnan(level_error(map_of(Eigen::VectorXd::Zero(40000)), 125, 240))) << "no power";
}
