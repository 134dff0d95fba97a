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
  EXPECT_NEAR(r.e, 0.546, 5e-4);  // 1.5 tan 20 deg
  EXPECT_NEAR(r.Y, 1.099, 5e-4);  // 0.4 cot 20 deg
  EXPECT_NEAR(r.pair_Y1, 1.236, 5e-4);
  EXPECT_NEAR(r.pair_Y2, 1.841, 5e-4);
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
  EXPECT_NEAR(roller_approach(law, 10e3) * 1e6, 21.1, 0.1);
}

TEST(BearingClearance, EndPlayAndRadialPlay)
{
  EXPECT_NEAR(clearance_of_end_play(0.3e-3, 20 * degree) * 1e3, 0.11, 0.005);
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
  EXPECT_NEAR(roller_triangle(b, 1).rib, 0.044, 5e-4);
  const double least = least_cup_load(b, 300);
  EXPECT_NEAR(roller_triangle(b, least, 300).cone, 0, 1e-10);
}
