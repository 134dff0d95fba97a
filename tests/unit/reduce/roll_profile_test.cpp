#include "reduce/chain/roll_profile.h"
#include "tests/support/near.h"

using namespace mill;
using reduce::radius_drop;

namespace {
Roll straight()
{
  Roll roll;
  roll.barrel_diameter = 0.42;
  roll.barrel_length   = 1.4;
  return roll;
}
}  // namespace

TEST(RollProfile, CrownIsTheDifferenceOfDiametersBetweenMiddleAndEnd)
{
  Roll roll  = straight();
  roll.crown = 80e-6;
  EXPECT_EQ(radius_drop(roll, 0), 0);
  EXPECT_TRUE(near(radius_drop(roll, 0.7), 40e-6, within(1e-12, "definition")));
  EXPECT_TRUE(near(radius_drop(roll, -0.35), 10e-6, within(1e-12, "parabola")));
  Roll warm          = straight();
  warm.thermal_crown = 80e-6;
  EXPECT_EQ(radius_drop(warm, 0.5), radius_drop(roll, 0.5));
  warm.crown = -80e-6;
  EXPECT_TRUE(near(radius_drop(warm, 0.6), 0, within_absolute(1e-18, "m, the profile begins there, rounding")));
}

TEST(RollProfile, PolynomialTableAndParabolaAreOneProfile)
{
  Roll parabola = straight(), polynomial = straight(), table = straight();
  parabola.crown              = 60e-6;
  polynomial.crown_polynomial = {{2, -60e-6}};
  for (int i = -70; i <= 70; ++i)
    table.crown_table.push_back({0.01 * i, 1e-3 - 60e-6 * i * i / 4900.});
  for (double z = -0.7; z <= 0.7; z += 0.05) {
    EXPECT_TRUE(
        near(radius_drop(polynomial, z), radius_drop(parabola, z), within(1e-12, "the same formula", 30e-6)));
    EXPECT_TRUE(near(radius_drop(table, z), radius_drop(parabola, z),
                     within(1e-4, "a table of 10 mm steps bends less between its points", 30e-6)));
  }
}

TEST(RollProfile, OddPowersMakeOneSideLarger)
{
  Roll roll             = straight();
  roll.crown_polynomial = {{1, 100e-6}, {3, -40e-6}};
  EXPECT_TRUE(near(radius_drop(roll, 0.7), -30e-6, within(1e-12, "half of 100 - 40 um, larger roll")));
  EXPECT_TRUE(near(radius_drop(roll, -0.7), 30e-6, within(1e-12, "point symmetric")));
  EXPECT_TRUE(reduce::is_one_sided(roll));
  EXPECT_FALSE(reduce::is_one_sided(straight()));
}

TEST(RollProfile, ChamferBeginsAtItsLengthFromTheEnd)
{
  Roll roll               = straight();
  roll.end_chamfer_length = 0.05;
  roll.end_chamfer_depth  = 200e-6;
  EXPECT_EQ(radius_drop(roll, 0.64), 0);
  EXPECT_TRUE(near(radius_drop(roll, 0.65), 0, within_absolute(1e-15, "m, the profile begins there, rounding")));
  EXPECT_TRUE(near(radius_drop(roll, -0.675), 100e-6, within(1e-9, "half way")));
  EXPECT_TRUE(near(radius_drop(roll, 0.7), 200e-6, within(1e-9, "at the end")));
}

TEST(RollProfile, CrossedAxesAreAsFarApartAsPythagorasSays)
{
  const double D = 0.935, angle = 2e-3, offset = 1e-3, z = 0.6;
  const double aside = offset + z * std::tan(angle);
  EXPECT_TRUE(near(reduce::crossing_gap(D, angle, offset, z), std::sqrt(D * D + aside * aside) - D,
                   within(1e-9, "the difference of two nearly equal numbers in the reference")));
  EXPECT_EQ(reduce::crossing_gap(D, 0, 0, z), 0);
}
