#include "core/base/errors.h"
#include "reduce/bearing/geometry.h"
#include "tests/support/demo_bearing.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include <cmath>

using namespace mill;
using namespace mill::bearing;

namespace {
constexpr double degree = M_PI / 180;

}  // namespace

TEST(BearingGeometry, ApexClosesAtTheReferenceAngles)
{
  const auto angle = within(1e-9, "closed form");
  for (const auto &row : reference("bearing.apex")) {
    const ApexClosure closed = apex_closure(0.31115, row[0], 2.5 * degree, 39);
    EXPECT_TRUE(near(closed.axis_angle / degree, row[1], angle));
    EXPECT_TRUE(near(closed.cup_angle / degree, row[2], angle));
    EXPECT_TRUE(near(closed.cone_angle / degree, row[3], angle));
  }
  const double printed[5][5] = {{2.5, 20, 19.84, 21.09, 18.59},  // included cone deg, D_we mm, axis, cup, cone deg
                                {2.5, 23, 17.17, 18.42, 15.92},
                                {1.25, 21.5, 9.08, 9.71, 8.46},
                                {5.0, 21.5, 39.19, 41.69, 36.69},
                                {2.5, 21.5, 18.41, 19.66, 17.16}};
  for (const auto &row : printed) {
    const ApexClosure closed = apex_closure(0.31115, row[1] * 1e-3, row[0] * degree, 39);
    EXPECT_TRUE(
        near(closed.axis_angle / degree, row[2], within_absolute(0.01, "table of hundredths of a degree")));
    EXPECT_TRUE(near(closed.cup_angle / degree, row[3], within_absolute(0.01, "table of hundredths of a degree")));
    EXPECT_TRUE(
        near(closed.cone_angle / degree, row[4], within_absolute(0.01, "table of hundredths of a degree")));
  }
  EXPECT_TRUE(near(apex_closure(0.31115, 0.0215, 2.5 * degree, 39).largest_roller_diameter, 25.06e-3,
                   within(2e-4, "printed with four digits")));
}

TEST(BearingGeometry, RefusesAnAngleThatDoesNotClose)
{
  RollerBearing b = demo_bearing();
  EXPECT_NO_THROW(require_closed_apex(b));
  b.cup_angle = 20 * degree;  // half a degree is what a catalogue knows
  EXPECT_NO_THROW(require_closed_apex(b));
  b.cup_angle = 13.5 * degree;
  try {
    require_closed_apex(b);
    FAIL() << "accepted";
  } catch (const InputError &error) {
    EXPECT_STREQ(error.problems.at(0).message.c_str(), "bearing.trb: cup angle 13.5 deg does not close the apex "
                                                       "condition; with a 21.5 mm roller of 2.5 deg included on a "
                                                       "311.15 mm pitch circle it is 19.658 deg; the given angle "
                                                       "would need a roller diameter of 31.998 mm, more than the "
                                                       "25.064 mm at which neighbouring rollers touch");
  }
}

TEST(BearingGeometry, RefusesAConeWithoutAnyApex)
{
  EXPECT_THROW(apex_closure(0.31115, 0.0215, 10 * degree, 39), InputError);
}

TEST(BearingGeometry, CylindricalBearingNeedsNoApex)
{
  RollerBearing b     = demo_bearing();
  b.roller_cone_angle = b.cup_angle = 0;
  EXPECT_NO_THROW(require_closed_apex(b));
}

TEST(BearingGeometry, RowsAndRollersAreSpreadEvenly)
{
  const Eigen::Vector4d rows(-86.3205e-3, -28.7735e-3, 28.7735e-3, 86.3205e-3);  // pitch 230.188 mm / 4
  EXPECT_TRUE(near(row_positions(demo_bearing()), rows, within(1e-12, "division")));
  const Eigen::VectorXd azimuth = roller_azimuths(demo_bearing());
  EXPECT_EQ(azimuth.size(), 39);
  EXPECT_EQ(azimuth[0], 0);
  EXPECT_TRUE(near(azimuth[38], 2 * M_PI * 38 / 39, within(1e-14, "division")));
}
