#include "app/stages/response/turning_rolls.h"
#include "core/model/four_high.h"
#include <gtest/gtest.h>

TEST(TurningRolls, OfABearingWhoseStiffnessIsGivenHaveNoRollers)
{
  const mill::FourHigh stand;
  const auto rolls = mill::turning_rolls(stand);
  ASSERT_EQ(rolls.size(), 2u);
  for (const auto &roll : rolls)
    EXPECT_EQ(roll.bearing, nullptr) << word_of(roll.kind);
}
