// Pass frequencies of a bearing against the reference values and against rolling cones.
#include "reduce/bearing/pass_frequencies.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::bearing;

namespace {
const double degree = M_PI / 180;

/// Work-roll bearing of the demo stand, its cup angle that at which the apex condition closes.
RollerBearing work_roll_bearing()
{
  RollerBearing b;
  b.type              = BearingType::four_row_tapered;
  b.bore              = 0.2667;
  b.outside_diameter  = 0.3556;
  b.rollers_per_row   = 39;
  b.roller_diameter   = 0.0215;
  b.roller_cone_angle = 2.5 * degree;
  b.cup_angle         = closing_cup_angle(b);
  return b;
}
}  // namespace

TEST(PassFrequencies, ReferenceValuesByBothMethods)
{
  // twin.json, envelope.orders: an independent program.
  const double cage = 0.46721857354777463, outer = 18.22152436836321, inner = 20.77847563163679,
               roller      = 7.2049424548387435;
  const Tolerance rounding = within(1e-12, "closed forms in double precision");
  for (const PassFrequencies &p : {pass_frequencies(work_roll_bearing()), of_rolling_cones(work_roll_bearing())}) {
    EXPECT_TRUE(near(p.cage, cage, rounding));
    EXPECT_TRUE(near(p.outer, outer, rounding));
    EXPECT_TRUE(near(p.inner, inner, rounding));
    EXPECT_TRUE(near(p.roller, roller, rounding));
  }
}

TEST(PassFrequencies, OfACylindricalBearing)
{
  RollerBearing b;
  b.bore                  = 0.95;
  b.outside_diameter      = 1.25;
  b.rollers_per_row       = 32;
  b.roller_diameter       = 0.11;
  const auto p            = pass_frequencies(b);  // gamma = 0.11 / 1.1 = 0.1
  const Tolerance by_hand = within(1e-14, "by hand");
  EXPECT_TRUE(near(p.cage, 0.45, by_hand));
  EXPECT_TRUE(near(p.outer, 14.4, by_hand));
  EXPECT_TRUE(near(p.inner, 17.6, by_hand));
  EXPECT_TRUE(near(p.roller, 4.95, by_hand));
  EXPECT_TRUE(std::isnan(of_rolling_cones(b).cage)) << "no cones";
}

TEST(PassFrequencies, OfABallBearing)
{
  const auto p            = pass_frequencies(10, 0.020, 0.100, 60 * degree);  // gamma = 0.2 cos 60 deg = 0.1
  const Tolerance by_hand = within(1e-14, "by hand");
  EXPECT_TRUE(near(p.cage, 0.45, by_hand));
  EXPECT_TRUE(near(p.outer, 4.5, by_hand));
  EXPECT_TRUE(near(p.inner, 5.5, by_hand));
  EXPECT_TRUE(near(p.roller, 2.475, by_hand)) << "2.5 times 0.99";
}

TEST(PassFrequencies, AreNotGuessedWithoutSizes)
{
  RollerBearing b    = work_roll_bearing();
  b.outside_diameter = not_given;
  EXPECT_TRUE(std::isnan(pass_frequencies(b).cage));
  b                 = work_roll_bearing();
  b.roller_diameter = not_given;
  EXPECT_TRUE(std::isnan(pass_frequencies(b).outer));
}
