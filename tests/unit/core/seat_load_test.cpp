#include "core/model/seat_load.h"
#include "core/numerics/log_spacing.h"
#include "tests/support/near.h"
#include <cmath>

// Radial load of the bearings of a stand, against numbers by hand.
using namespace mill;

namespace {
constexpr double force = 1e6;  // N

FourHigh rolls()
{
  FourHigh stand;
  stand.work_roll.barrel_diameter   = 0.4;
  stand.backup_roll.barrel_diameter = 1.4;
  return stand;
}
}  // namespace

TEST(SeatLoad, ABackupBearingCarriesHalfTheForceAndAWorkRollsATwentieth)
{
  const FourHigh stand  = rolls();
  const SeatLoad backup = seat_load(stand, true, {}, force), work = seat_load(stand, false, {}, force);
  EXPECT_EQ(backup.value, 5e5);
  EXPECT_EQ(work.value, 5e4);
  EXPECT_FALSE(backup.assumed);
  EXPECT_TRUE(work.assumed);
}

TEST(SeatLoad, BendingPressesBothRolls)
{
  FourHigh stand                = rolls();
  stand.work_roll.bending_force = {100e3, 300e3};  // of the two chocks: 200 kN in the mean
  EXPECT_EQ(seat_load(stand, true, {}, force).value, 7e5);
  EXPECT_EQ(seat_load(stand, false, {}, force).value, 2e5);
  EXPECT_FALSE(seat_load(stand, false, {}, force).assumed);
}

TEST(SeatLoad, AnOffsetPushesAcross)
{
  ContactSettings contact;
  contact.axis_offset = -0.009;
  const double across = 0.5 * force * 0.009 / (0.2 + 0.7);  // 5 kN
  const SeatLoad load = seat_load(rolls(), true, contact, force);
  EXPECT_TRUE(near(load.across, across, within(1e-12, "F e / (R1 + R2), half on each side")));
  EXPECT_TRUE(near(load.value, std::sqrt(5e5 * 5e5 + across * across), within(1e-12, "at right angles")));
}

TEST(SeatLoad, AGivenLoadIsTheOnlyOneRead)
{
  FourHigh stand                = rolls();
  stand.work_roll.bearing_load  = 70e3;
  stand.work_roll.bending_force = {100e3, 100e3};
  const SeatLoad load           = seat_load(stand, false, {}, force);
  EXPECT_EQ(load.value, 70e3);
  EXPECT_TRUE(load.given);
  EXPECT_FALSE(load.assumed);
}

TEST(LogSpacing, RatiosAreEqual)
{
  const std::vector<double> values = evenly_in_logarithm(1, 1000, 4);
  ASSERT_EQ(values.size(), 4u);
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_TRUE(near(values[i], std::pow(10., double(i)), within(1e-12, "a factor of ten each")));
}
