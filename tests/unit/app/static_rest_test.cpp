// The static rest of the modes that an export leaves out.
#include "app/export/static_rest.h"
#include "app/stages/stand/mode_results.h"
#include "core/records/stand_model.h"
#include "dynamics/response/modal_model.h"
#include "reduce/stand/stand_comparison.h"
#include "reduce/stand/stand_modes.h"
#include "tests/support/near.h"
#include <array>
#include <cmath>
#include <memory>

using namespace mill;

namespace {
// Six masses, of which the export takes the modes below twice the limit.
DrivenStand stand_with_limit(const double limit)
{
  LumpedModel chain;
  const std::array<double, 6> masses{9322, 59717, 1889, 3095, 42201, 4663};
  const std::array<double, 7> springs{6.3e9, 10.2e9, 40e9, 0, 45e9, 29e9, 6.9e9};
  for (std::size_t i = 0; i < masses.size(); ++i)
    chain.M[i].value = masses[i];
  for (std::size_t i = 0; i < springs.size(); ++i)
    chain.K[i].value = springs[i];
  DrivenStand stand;
  stand.dynamics.frequency_limit = limit;
  stand.detailed = std::make_shared<const reduce::StandWithModes>(chain_with_modes(chain, stand.dynamics));
  stand.modes    = dynamics::modal_model(stand.detailed->model, stand.detailed->modes.frequency,
                                         stand.detailed->modes.shape, 0.01, 2 * limit);
  return stand;
}
}  // namespace

TEST(StaticRest, DisplacementsUnderAConstantForceAreThoseOfTheWholeStand)
{
  DrivenStand stand = stand_with_limit(100);
  const auto before = *stand.modes;
  ASSERT_LT(before.frequency.size(), 6);
  add_static_rest(stand);
  ASSERT_TRUE(stand.rest);
  const auto &modes = *stand.modes;
  EXPECT_EQ(modes.frequency.size(), before.frequency.size() + 1);
  EXPECT_EQ(modes.frequency.head(before.frequency.size()), before.frequency) << "kept modes stay as they are";
  EXPECT_GT(modes.frequency.tail(1)[0], before.frequency.maxCoeff());
  const Eigen::VectorXd whole = reduce::static_displacement(stand.detailed->model);
  const Eigen::VectorXd q     = modes.force.cwiseQuotient((2 * M_PI * modes.frequency).cwiseAbs2());
  for (std::size_t p = 0; p < stand.detailed->model.points.size(); ++p) {
    const double exact = stand.detailed->model.points[p].row.dot(whole);
    EXPECT_TRUE(near(modes.point.row(Eigen::Index(p)).dot(q), exact,
                     within(1e-9, "rounding of one solution and of the sum of the modes")));
  }
  EXPECT_TRUE(near(modes.load_cell.dot(q), stand.detailed->model.load_cell.dot(whole),
                   within(1e-9, "rounding of one solution and of the sum of the modes")));
  EXPECT_EQ(stand.rest->all, 6);
  EXPECT_GT(stand.rest->missing, 0);
  EXPECT_LT(stand.rest->missing, 1);
}

TEST(StaticRest, WithAllModesNothingIsMissing)
{
  DrivenStand stand = stand_with_limit(1e4);
  add_static_rest(stand);
  ASSERT_TRUE(stand.rest);
  EXPECT_TRUE(near(stand.rest->missing, 0, within_absolute(1e-9, "rounding")));
  EXPECT_TRUE(near(stand.rest->error, 0, within_absolute(1e-9, "rounding")));
}

TEST(StaticRest, AChainStaysAsItIs)
{
  DrivenStand stand = stand_with_limit(100);
  stand.modes.reset();
  add_static_rest(stand);
  EXPECT_FALSE(stand.rest);
}
