#include "reduce/bearing/clearance.h"
#include "reduce/bearing/ratings.h"
#include "reduce/bearing/roller_set.h"
#include "tests/support/demo_bearing.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::bearing;

namespace {
constexpr double degree = M_PI / 180;
}

TEST(BearingRatings, AxialFactors)
{
  const Ratings r = ratings(demo_bearing(20));
  EXPECT_TRUE(near(r.e, 0.546, within_absolute(5e-4, "1.5 tan 20 deg, printed with three decimals")));
  EXPECT_TRUE(near(r.Y, 1.099, within_absolute(5e-4, "0.4 cot 20 deg, printed with three decimals")));
  EXPECT_TRUE(near(r.pair_Y1, 1.236, within_absolute(5e-4, "printed with three decimals")));
  EXPECT_TRUE(near(r.pair_Y2, 1.841, within_absolute(5e-4, "printed with three decimals")));
  EXPECT_EQ(r.X, 0.4);
  EXPECT_EQ(r.pair_X2, 0.67);
  RollerBearing b   = demo_bearing();
  b.roller_diameter = not_given;
  EXPECT_THROW(ratings(b), InputError);
  EXPECT_THROW(rating_factor(1.2), InputError);
}

TEST(BearingRatings, DampingOfALumpedBearing)
{
  const DampingRange c = bearing_damping(2e10);
  EXPECT_TRUE(near(c.low, 5e4, within(1e-12, "0.25e-5 s")));
  EXPECT_TRUE(near(c.middle, 2.5e5, within(1e-12, "1.25e-5 s")));
  EXPECT_TRUE(near(c.high, 5e5, within(1e-12, "2.5e-5 s")));
  EXPECT_THROW(friswell_stiffness(demo_bearing(), 0), InputError);
}

// 21.1 um at 10 kN, a tenth softer than the standard's law.
TEST(BearingRatings, LuoLawOfTheDemoRoller)
{
  const RollerLaw law = luo_law(demo_bearing(), 2 * 144.825e-3, 2 * 166.325e-3);
  EXPECT_TRUE(near(roller_approach(law, 10e3) * 1e6, 21.1, within_absolute(0.1, "printed with one decimal")));
}

TEST(BearingClearance, EndPlayAndRadialPlay)
{
  EXPECT_TRUE(near(clearance_of_end_play(0.3e-3, 20 * degree) * 1e3, 0.11,
                   within_absolute(0.005, "printed with two decimals")));
  RollerBearing b = demo_bearing(20);
  b.end_play      = 0.3e-3;
  EXPECT_TRUE(near(diametral_clearance(b), 0.3e-3 * std::tan(20 * degree), within(1e-14, "replaces the other")));
  b         = demo_bearing(0);
  b.preload = 1e3;
  EXPECT_THROW(preloaded_roller(b), InputError);
}

// Forces on the roller add up to zero along the bearing's axis and across it, with and without speed.
TEST(RollerTriangle, IsInEquilibrium)
{
  RollerBearing b = demo_bearing(20);
  for (const double rib : {not_given, 70 * degree})
    for (const double centrifugal : {0.0, 300.0}) {
      b.rib_angle      = rib;
      const double cup = 10e3, outer = b.cup_angle, inner = outer - b.roller_cone_angle, f = rib_angle(b);
      const RollerTriangle t = roller_triangle(b, cup, centrifugal);
      EXPECT_TRUE(near(cup * std::cos(outer), t.cone * std::cos(inner) - t.rib * std::cos(f) + centrifugal,
                       within(1e-12, "across the axis")));
      EXPECT_TRUE(near(cup * std::sin(outer), t.cone * std::sin(inner) + t.rib * std::sin(f),
                       within(1e-12, "along the axis")));
    }
  b.rib_angle = not_given;
  EXPECT_TRUE(near(roller_triangle(b, 1).rib, 0.044, within_absolute(5e-4, "printed with three decimals")));
  const double least = least_cup_load(b, 300);
  EXPECT_TRUE(near(roller_triangle(b, least, 300).cone, 0,
                   within_absolute(1e-10, "bisection for the load at which the cone carries nothing")));
}
