// What a calibration refuses and accepts at a plant: a stand with another frame, damping that differs from mode to
// mode, small errors of all parameters.  Right stands drawn from their stated errors (RE-6) and all wrong ones
// (RE-7) are in tests/campaign/twin/plant_stands_test.cpp.
#include "tests/support/plant_stands.h"

using namespace mill;
using namespace mill::twin;

TEST(PlantCalibrationLong, RefusesAWrongStand)
{
  expect_refused(wrong_stands().front(), 0);
}

// Half of the ratios of the modes are others: bands near them fail with one ratio for all modes, and nothing else
// does.
TEST(PlantCalibration, NamesTheCommonDampingWhereItAloneFails)
{
  calibration::Recipe recipe = recipe_of(9000);
  recipe.truth               = {{"K3", -0.03}, {"zeta3", 0.9}, {"zeta5", -0.7}};
  const std::vector<Unknown> unknowns{{"K3", 0.05}, {"zeta", std::log(2.)}};
  const CalibrationInput input = calibration_of(recipe, unknowns);
  const Calibration done       = calibrate(input, {});
  ASSERT_FALSE(done.refusals.empty());
  const std::vector<std::string> names{"K3", "zeta1", "zeta2", "zeta3", "zeta4", "zeta5", "zeta6"};
  EXPECT_EQ(done.with_ratios, names);
  bool offered = false;
  for (const std::string &reason : done.refusals)
    offered = offered || reason.find("--free \"K3,zeta1,zeta2,zeta3,zeta4,zeta5,zeta6\"") != std::string::npos;
  EXPECT_TRUE(offered) << done.refusals.back();
  std::vector<Unknown> each{unknowns[0]};
  for (std::size_t i = 1; i < names.size(); ++i)
    each.push_back({names[i], std::log(2.), 0});
  CalibrationInput with_ratios = input;
  with_ratios.unknowns         = each;
  const Calibration again      = calibrate(with_ratios, {});
  EXPECT_TRUE(again.refusals.empty()) << again.refusals.front();
}

// A fit that has small errors in all twelve parameters is far above the noise of good sensors, and within the
// model error that is stated.
TEST(PlantCalibration, AcceptsSmallErrorsOfAllParameters)
{
  calibration::Recipe recipe = recipe_of(9100);
  recipe.density             = 1e-4;  // fifty times better sensors
  const std::vector<Unknown> unknowns{{"zeta", std::log(2.)}};
  // all frequencies are 0.04 % higher: 4 % of the level at the top of a resonance of 1 %
  for (const char *name : {"K1", "K2", "K3", "K5", "K6", "K7", "M1", "M2", "M3", "M4", "M5", "M6"})
    recipe.truth[name] = name[0] == 'K' ? 0.0004 : -0.0004;
  CalibrationInput input = calibration_of(recipe, unknowns);
  const auto bands_fail  = [](const Calibration &done) {
    return wrong_bands(done.fit.bands).count + wrong_bands(done.check.bands).count > 0;
  };
  EXPECT_FALSE(bands_fail(calibrate(input, {})));
  input.model_error = 1e-6;
  EXPECT_TRUE(bands_fail(calibrate(input, {}))) << "the noise alone would refuse it";
}
