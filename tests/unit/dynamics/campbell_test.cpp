// Orders of what turns and the speeds at which they meet modes.
#include "dynamics/response/campbell.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::dynamics;

namespace {
const double work_roll = 0.5, backup_roll = 1.25;  // m

CampbellRecord record()
{
  CampbellRecord r;
  r.modes     = {{"a", "first", 60, 0.01}, {"b", "second", 300, 0.02}};
  r.lines     = {line_of("order 10", "work roll", "work roll", 10, work_roll),
                 line_of("order 20", "work roll", "work roll", 20, work_roll),
                 line_of("teeth", "drive", "backup roll", 23.5, backup_roll)};
  r.speeds    = {1, 20};
  r.working   = {8, 12};
  r.crossings = crossings(r.modes, r.lines, r.speeds, r.working);
  return r;
}
}  // namespace

TEST(Campbell, ALineIsItsOrderTimesTheTurnsOfTheRoll)
{
  const CampbellLine line = line_of("teeth", "drive", "backup roll", 23, backup_roll);
  const double v          = 5;  // 5 m/s are 1.2732 turns of the roll in a second
  EXPECT_TRUE(near(line.per_length * v, 23 * 5 / (M_PI * 1.25), within(1e-14, "definition")));
  EXPECT_EQ(line.per_turn, 23);
}

TEST(Campbell, CrossingsLieOnLineAndMode)
{
  const CampbellRecord r = record();
  ASSERT_EQ(r.crossings.size(), 3u);  // the second mode is beyond the speeds of order 10 and of the teeth
  for (const CampbellCrossing &c : r.crossings) {
    EXPECT_TRUE(near(r.lines[std::size_t(c.line)].per_length * c.speed, r.modes[std::size_t(c.mode)].frequency,
                     within(1e-14, "definition")));
    EXPECT_GE(c.speed, r.speeds[0]);
    EXPECT_LE(c.speed, r.speeds[1]);
  }
  EXPECT_TRUE(near(r.crossings[0].speed, 60 * M_PI * 0.5 / 20, within(1e-14, "by hand")));
  EXPECT_EQ(r.crossings[0].line, 1);
  EXPECT_TRUE(near(r.crossings[0].distance, 60 * M_PI * 0.5 / 20 / 8 - 1, within(1e-13, "below the lower end")));
}

TEST(Campbell, DistanceIsOverTheNearerEnd)
{
  const std::array<double, 2> range{8, 12};
  EXPECT_TRUE(near(distance_from(6, range), -0.25, within(1e-15, "by hand")));
  EXPECT_EQ(distance_from(8, range), 0);
  EXPECT_EQ(distance_from(12, range), 0);
  EXPECT_TRUE(near(distance_from(15, range), 0.25, within(1e-15, "by hand")));
  EXPECT_TRUE(std::isnan(distance_from(15, {not_given, not_given})));
}

TEST(Campbell, TheCrossingNearestToTheWorkingRangeComesFirst)
{
  const CampbellRecord r = record();
  // 60 Hz: order 20 at 4.71 m/s, order 10 at 9.42 m/s, teeth at 10.03 m/s, which is nearer to the middle.
  const auto crossing = nearest(r, 0);
  ASSERT_TRUE(crossing);
  EXPECT_EQ(crossing->line, 2);
  EXPECT_EQ(crossing->distance, 0);
  EXPECT_FALSE(nearest(r, 1)) << "300 Hz is met by nothing up to 20 m/s";
  CampbellRecord without = r;
  for (CampbellCrossing &c : without.crossings)
    c.distance = not_given;
  EXPECT_FALSE(nearest(without, 0)) << "no range, no distance";
}
