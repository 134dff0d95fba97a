// The gain of the error between two meshes of the rolls goes by the meshes that were made.
#include "app/stages/stand/stand_components.h"
#include "fem/roll/roll_component.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;

namespace {
ComponentSets rolls(const int work, const int backup)
{
  ComponentSets sets;
  sets.present                                = true;
  sets.fine.work_roll.elements_per_radius     = work;
  sets.coarse.work_roll.elements_per_radius   = work - 1;
  sets.fine.backup_roll.elements_per_radius   = backup;
  sets.coarse.backup_roll.elements_per_radius = backup - 1;
  return sets;
}
}  // namespace

TEST(RollMeshGain, TheGainIsThatOfTheMeshesUsed)
{
  const auto expected = [](const double n) { return std::pow(n / (n - 1), fem::shoulder_order); };
  const auto exact    = within(1e-14, "the same power");
  EXPECT_TRUE(near(roll_mesh_gain(rolls(3, 3)), expected(3), exact));
  EXPECT_TRUE(near(roll_mesh_gain(rolls(3, 6)), expected(6), exact)) << "the pair that differs less errs more";
  EXPECT_TRUE(near(roll_mesh_gain(rolls(5, 3)), expected(5), exact));
  EXPECT_EQ(solid_rolls(rolls(4, 3)).gain, roll_mesh_gain(rolls(4, 3)));
  EXPECT_FALSE(solid_rolls(ComponentSets{})) << "nothing was meshed";
}
