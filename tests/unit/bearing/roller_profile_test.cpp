#include "core/base/errors.h"
#include "reduce/bearing/roller_law.h"
#include "reduce/bearing/roller_profile.h"
#include "tests/support/demo_bearing.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::bearing;
using Eigen::VectorXd;

namespace {
constexpr double um = 1e-6, L = 33.4e-3;

RollerBearing with_profile(const RollerProfile profile)
{
  RollerBearing b = demo_bearing();
  b.profile       = profile;
  return b;
}

double drop(const RollerBearing &b, const double x)
{
  return profile_drop(b, VectorXd::Constant(1, x))[0];
}

// Prefactor of the logarithm for one contact of two steel bodies.
double unit_drop(const double load)
{
  return 2 * (1 - 0.3 * 0.3) / (M_PI * 206e9) * load / L;
}
}  // namespace

TEST(RollerProfile, LundbergIsTheLogarithmForItsLoad)
{
  RollerBearing b = with_profile(RollerProfile::lundberg);
  b.profile_load  = 50e3;
  const double u  = 0.8;
  EXPECT_TRUE(near(drop(b, u * L / 2), -unit_drop(50e3) * std::log(1 - u * u), within(1e-12, "closed form")));
  EXPECT_EQ(drop(b, 0), 0);
  RollerBearing twice = b;
  twice.profile_load  = 100e3;
  EXPECT_TRUE(near(drop(twice, -0.01), 2 * drop(b, 0.01), within(1e-12, "proportional to the load, even")));
}

TEST(RollerProfile, LogIsLundbergRoundedAtTheEnd)
{
  RollerBearing log = with_profile(RollerProfile::log), lundberg = with_profile(RollerProfile::lundberg);
  log.profile_load = lundberg.profile_load = 50e3;
  const double R = effective_radius(log, true), E_plane = 206e9 / (2 * 0.91);
  const double b = std::sqrt(4 * 50e3 / L * R / (M_PI * E_plane));
  EXPECT_TRUE(near(drop(log, L / 2), -unit_drop(50e3) * std::log(0.3033 * 2 * b / L),
                   within(1e-12, "Johns and Gohar's end drop")));
  EXPECT_LT(drop(log, 0.9 * L / 2), drop(lundberg, 0.9 * L / 2));
  EXPECT_TRUE(near(drop(log, 0.2 * L), drop(lundberg, 0.2 * L), within(0.01, "away from the end they are one")));
}

TEST(RollerProfile, ThreeParameterEndsAtItsDropAndStartsStraight)
{
  RollerBearing b = with_profile(RollerProfile::three_parameter);
  b.profile_load  = 40e3;
  b.profile_share = 0.6;
  b.crown_drop    = 15 * um;
  EXPECT_EQ(drop(b, 0.39 * L / 2), 0);
  EXPECT_GT(drop(b, 0.41 * L / 2), 0);
  EXPECT_TRUE(near(drop(b, L / 2), 15 * um, within(1e-12, "the end drop is a parameter")));
  EXPECT_TRUE(near(drop(b, -L / 2), 15 * um, within(1e-12, "even")));
  // All of the length and no end to the drop: Lundberg's profile.
  b.profile_share        = 1;
  b.crown_drop           = 1;
  RollerBearing lundberg = with_profile(RollerProfile::lundberg);
  lundberg.profile_load  = 40e3;
  EXPECT_TRUE(near(drop(b, 0.3 * L), drop(lundberg, 0.3 * L), within(1e-12, "exp(-drop/A) is zero")));
}

TEST(RollerProfile, TableIsLinearAndMirroredWithoutNegativeX)
{
  RollerBearing b = with_profile(RollerProfile::table);
  b.profile_table = {{0, 0}, {10e-3, 2 * um}, {17e-3, 9 * um}};
  EXPECT_TRUE(near(drop(b, 5e-3), 1 * um, within(1e-12, "half way")));
  EXPECT_TRUE(near(drop(b, -13.5e-3), 5.5 * um, within(1e-12, "mirrored")));
  b.profile_table = {{-17e-3, 4 * um}, {0, 0}, {17e-3, 9 * um}};
  EXPECT_TRUE(near(drop(b, -8.5e-3), 2 * um, within(1e-12, "its own side")));
  EXPECT_TRUE(near(drop(b, 8.5e-3), 4.5 * um, within(1e-12, "its own side")));
  b.profile_table = {{5e-3, 1 * um}, {17e-3, 9 * um}};
  EXPECT_TRUE(near(drop(b, 2e-3), 1 * um, within(1e-12, "level up to the first point")));
}

TEST(RollerProfile, TotalLengthDoesNotCarry)
{
  RollerBearing b       = with_profile(RollerProfile::iso);
  const RollerLaw law   = roller_law(b);
  b.roller_total_length = 36e-3;
  EXPECT_EQ(roller_law(b).position, law.position);
  EXPECT_EQ(roller_law(b).drop, law.drop);
  EXPECT_TRUE(
      near(law.position[40] + law.slice_length / 2, L / 2, within(1e-12, "slices fill the effective length")));
}

TEST(RollerProfile, RefusesWhatIsMissing)
{
  const auto refused = [](RollerBearing b, const std::string &part) {
    try {
      drop(b, 0.01);
    } catch (const InputError &error) {
      return error.problems.at(0).message.find(part) != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refused(with_profile(RollerProfile::crown), "needs crown_drop"));
  EXPECT_TRUE(refused(with_profile(RollerProfile::three_parameter), "needs crown_drop"));
  RollerBearing b = with_profile(RollerProfile::three_parameter);
  b.crown_drop    = 1 * um;
  b.profile_share = 0;
  EXPECT_TRUE(refused(b, "profile_share"));
  b.profile_share = 1;
  b.crown_drop    = 0;
  EXPECT_TRUE(refused(b, "above 0"));
  EXPECT_TRUE(refused(with_profile(RollerProfile::table), "profile_table"));
  b               = with_profile(RollerProfile::table);
  b.profile_table = {{0, 0}, {5e-3, 1 * um}};
  EXPECT_TRUE(refused(b, "ends before the roller does"));
  b.profile_table = {{0, 0}, {0, 1 * um}};
  EXPECT_TRUE(refused(b, "must increase"));
  b                 = with_profile(RollerProfile::lundberg);
  b.roller_diameter = not_given;
  EXPECT_TRUE(refused(b, "roller_diameter"));
}
