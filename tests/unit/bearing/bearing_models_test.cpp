// Models that a bearing is compared with, and the bound of its roller loads.
#include "reduce/bearing/asked_load.h"
#include "reduce/bearing/bearing_models.h"
#include "reduce/bearing/geometry.h"
#include "tests/support/demo_bearing.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::bearing;

TEST(AskedLoad, BoundIsAPowerOfTwoAboveWhatEquilibriumGives)
{
  const RollerBearing b = demo_bearing(20);
  std::vector<AskedLoad> asked(4);
  asked[0].radial             = 1e6;
  asked[1].axial              = 4e5;
  asked[2].moment             = 2e4;
  asked[3].axial_displacement = 4e-5;
  for (const AskedLoad &one : asked) {
    const double bound = largest_roller_load(b, one);
    const double heaviest =
        BearingAssembly(rigid_model(b)).solve(drive_of(one, one.radial)).roller_load.maxCoeff();
    EXPECT_GT(bound, heaviest);
    EXPECT_EQ(std::exp2(std::round(std::log2(bound / 1e3))), bound / 1e3);
  }
  asked[0].loads = {1e6, 8e6};
  EXPECT_EQ(largest_roller_load(b, asked[0]), roller_load_bound(b, 8e6, 0));
}

TEST(AskedLoad, DrivesTheRing)
{
  AskedLoad asked;
  asked.tilt = 1e-3;
  auto drive = drive_of(asked, 5e5);
  EXPECT_EQ(drive.value[0], 5e5);
  EXPECT_TRUE(drive.prescribed[2] && drive.prescribed[4]);
  EXPECT_EQ(drive.value[4], 1e-3);
  asked.axial  = 1e5;
  asked.moment = 2e3;
  drive        = drive_of(asked, 5e5);
  EXPECT_FALSE(drive.prescribed[2] || drive.prescribed[4]);
  EXPECT_EQ(drive.value[4], 2e3);
  asked.axial_displacement = 1e-5;
  EXPECT_TRUE(drive_of(asked, 5e5).prescribed[2]);
}

TEST(BearingModels, PlacesThatAreNotGivenDoNotMatterUnderARadialLoad)
{
  RollerBearing given     = demo_bearing(0);
  given.roller_cone_angle = 0;
  RollerBearing open      = given;
  open.width              = not_given;
  open.bore               = not_given;
  const RollerBearing set = between_rigid_rings(open);
  EXPECT_EQ(set.width, 4 * 0.0334);
  EXPECT_TRUE(near(pitch_diameter(set), 39 * 0.0215 / M_PI, within(1e-12, "rollers that touch")));
  const auto secant = [](const RollerBearing &b) {
    return radial_secant(BearingAssembly(model_by_law(b, OneRollerLaw::iso)).solve(radial_drive(1e6)));
  };
  EXPECT_TRUE(near(secant(open), secant(given), within(1e-9, "the same rollers at the same angles")));
}

TEST(BearingModels, NeighbouringLawHasTheOtherConstant)
{
  const BearingModel iso      = model_by_law(demo_bearing(), OneRollerLaw::iso);
  const BearingModel palmgren = with_neighbouring_law(iso);
  EXPECT_TRUE(near(palmgren.roller.lamina_constant / iso.roller.lamina_constant, 37310. / 35948,
                   within(1e-4, "printed digits of (5.4)")));
  EXPECT_EQ(with_neighbouring_law(model_by_law(demo_bearing(), OneRollerLaw::palmgren)).roller.lamina_constant,
            iso.roller.lamina_constant);
}

TEST(BearingModels, OtherArrangementsAreThoseThatTheCaseLeavesOpen)
{
  RollerBearing b = demo_bearing();
  EXPECT_TRUE(other_arrangements(rigid_model(b)).empty());
  b.arrangement_assumed = true;
  const auto others     = other_arrangements(rigid_model(b));
  ASSERT_FALSE(others.empty());
  for (const BearingVariant &other : others)
    EXPECT_NE(other.about, arrangement_name(b.arrangement, b.rows));
}

// At the share that it states the pressure is that of yield: exact for a power law.
TEST(BearingModels, RestingFitReachesYieldAtItsShare)
{
  RollerBearing b = demo_bearing(20);
  b.profile       = RollerProfile::none;
  EXPECT_FALSE(resting_fit(b)) << "no clearance, no interference";
  RollerBearing preloaded = b;
  preloaded.preload       = 5e6;
  const auto fit          = resting_fit(preloaded);
  ASSERT_TRUE(fit);
  EXPECT_TRUE(near(fit->load, 5e6 / (39 * std::sin(b.cup_angle)), within(1e-9, "force of one row")));
  preloaded.preload *= fit->yield_share;
  EXPECT_TRUE(near(resting_fit(preloaded)->pressure, b.yield_pressure, within(1e-9, "root of the load")));
  b.radial_clearance = -1e-3;
  const auto pressed = resting_fit(b);
  ASSERT_TRUE(pressed);
  b.radial_clearance *= pressed->yield_share;
  EXPECT_TRUE(near(resting_fit(b)->pressure, b.yield_pressure, within(1e-9, "interference to the 5/9")));
}
