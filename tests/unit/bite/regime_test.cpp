#include "core/base/errors.h"
#include "reduce/bite/slab/karman.h"
#include "reduce/bite/slab/regime.h"
#include "reduce/bite/slab/skidding.h"
#include "tests/support/near.h"
#include <gtest/gtest.h>

// Which solver serves a pass, and how far it is from skidding.
namespace {
using namespace mill;

bite::RollBite pass(const double entry, const double exit, const double radius, const double k, const double mu)
{
  bite::RollBite b;
  b.roll_radius                = radius;
  b.roll                       = {210e9, 0.3};
  b.strip.width                = 1;
  b.strip.entry_thickness      = entry;
  b.strip.exit_thickness       = exit;
  b.strip.flow_stress.k        = k;
  b.strip.friction.coefficient = mu;
  return b;
}
}  // namespace

TEST(Regime, TheMarginIsTheFrictionAtWhichKarmanRefuses)
{
  const bite::RollBite b = pass(0.9e-3, 0.6e-3, 0.2925, 700e6, 0.04);
  const double margin    = bite::friction_margin(b, b.roll_radius, 0.04);
  const auto taken       = [&](const double mu) {
    bite::RollBite other             = b;
    other.strip.friction.coefficient = mu;
    try {
      bite::solve_karman(other, bite::Theory::karman, bite::Arc::rigid);
      return true;
    } catch (const InputError &) {
      return false;
    }
  };
  ASSERT_GT(margin, 1);
  EXPECT_TRUE(taken(1.02 * 0.04 / margin));
  EXPECT_FALSE(taken(0.98 * 0.04 / margin));
}

TEST(Regime, TheMarginOfTooLittleFrictionIsBelowOne)
{
  const bite::RollBite b = pass(8e-3, 5e-3, 0.21, 28e6, 0.03);
  const double margin    = bite::friction_margin(b, b.roll_radius, 0.03);
  EXPECT_LT(margin, 1);
  EXPECT_TRUE(near(bite::friction_margin(b, b.roll_radius, 0.06), 2 * margin,
                   within_absolute(0.05 * margin, "the search ends in a bracket of 1 % of the friction")));
}

TEST(Regime, AFlattenedArcAsksForLessFriction)
{
  const bite::RollBite b = pass(0.27e-3, 0.24e-3, 0.04, 750e6, 0.034);
  EXPECT_GT(bite::friction_margin(b, 1.7 * b.roll_radius, 0.034), bite::friction_margin(b, b.roll_radius, 0.034));
}

TEST(Regime, HotThickStripIsRigidPlasticAndThinHardStripElastic)
{
  EXPECT_FALSE(bite::regime_of(pass(8e-3, 5e-3, 0.21, 28e6, 0.2)).elastic_strip);
  const bite::Regime plate = bite::regime_of(pass(0.1, 0.095, 0.5, 100e6, 0.4));
  EXPECT_LT(plate.arc_over_thickness, 1);
  EXPECT_FALSE(plate.elastic_strip);
  const bite::Regime foil = bite::regime_of(pass(0.243e-3, 0.2126e-3, 0.0934, 583e6, 0.04));
  EXPECT_TRUE(foil.elastic_strip);
  EXPECT_GT(foil.flattening, 1.3);  // a thin strip, hard for this roll
  EXPECT_NE(foil.reason.find("R'/R"), std::string::npos);
}

TEST(Regime, ThePassIsCheckedFirst)
{
  EXPECT_THROW(bite::regime_of(pass(5e-3, 8e-3, 0.21, 28e6, 0.2)), InputError);
}
