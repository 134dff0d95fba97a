// What a run on curves says about linear springs: from numbers by hand, and from a contact that is linear.
#include "dynamics/nonlinear/curve_study.h"
#include "tests/support/curve_stands.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::dynamics;

namespace {
NonlinearSpring spring(const std::string &name, const double least, const int parted)
{
  NonlinearSpring s;
  s.name    = name;
  s.rest    = 1e6;
  s.low     = 5e5;
  s.high    = 2e6;
  s.least   = least;
  s.largest = 1.2;
  s.parted  = parted;
  return s;
}

NonlinearMode mode(const double bend, const double parting_force)
{
  NonlinearMode m;
  m.bend          = bend;
  m.parting_force = parting_force;
  return m;
}
}  // namespace

TEST(CurveStudy, LinearSpringsAreEnoughWithinAPercentOfEveryLevel)
{
  NonlinearRecord record;
  record.rolls    = {{"upper work roll", 1.004, 2.01, 1, 2, 1, 2.03}, {"lower work roll", 0.992, 1, 1, 1, 1, 1}};
  record.springs  = {spring("K3", 0.9, 0), spring("K5", 0.8, 0)};
  const auto good = linear_verdict(record);
  EXPECT_TRUE(good.enough);
  EXPECT_TRUE(near(good.furthest, -0.008, within(1e-12, "the lower peak")));
  EXPECT_EQ(good.softest, &record.springs[1]);
  EXPECT_TRUE(near(level_error(record.rolls[0]), 0.02 / 2.01, within(1e-12, "fixed steps")));
  record.rolls[1].rms = 1.02;
  EXPECT_FALSE(linear_verdict(record).enough);
  record.rolls[1].rms      = 1;
  record.springs[0].parted = 2;
  EXPECT_FALSE(linear_verdict(record).enough);
  EXPECT_TRUE(linear_verdict(record).parts);
  record.springs             = {spring("K3", 1, 0)};
  record.rolls[0].linear_rms = 0;
  EXPECT_EQ(linear_verdict(record).softest, nullptr) << "no force falls";
  EXPECT_FALSE(linear_verdict(record).enough) << "a ratio without a value is far";
}

// 0/0 of a roll that stands still, or the NaN of a run that did not hold: whichever roll has it, and whatever the
// other one does.
TEST(CurveStudy, ALevelWithoutARatioIsNeverEnough)
{
  const NonlinearRoll close{"work roll", 1.005, 1.005, 1, 1, 1, 1}, far{"work roll", 2, 2, 1, 1, 1, 1},
      at_rest{"work roll", 0, 0, 0, 0, 0, 0}, broken{"work roll", not_given, not_given, 1, 1, 1, 1},
      peak_alone{"work roll", not_given, 1, 1, 1, 1, 1};
  for (const NonlinearRoll &without : {at_rest, broken, peak_alone})
    for (const NonlinearRoll &other : {close, far})
      for (const auto &rolls : {std::vector{without, other}, std::vector{other, without}}) {
        NonlinearRecord record;
        record.rolls       = rolls;
        const auto verdict = linear_verdict(record);
        EXPECT_TRUE(std::isnan(verdict.furthest));
        EXPECT_FALSE(verdict.enough);
      }
  NonlinearRecord record;
  record.rolls = {close, close};
  EXPECT_TRUE(linear_verdict(record).enough);
  record.rolls = {far, close};
  EXPECT_TRUE(near(linear_verdict(record).furthest, 1, within(1e-12, "2 against 1")));
}

TEST(CurveStudy, SamplesAreLeftAboveAndBelowUnlessASpringParts)
{
  EXPECT_FALSE(leaves_samples(spring("K3", 0.5, 0)));
  EXPECT_TRUE(leaves_samples(spring("K3", 0.49, 0)));
  EXPECT_FALSE(leaves_samples(spring("K3", 0, 1))) << "below them lies nothing but the gap";
  NonlinearSpring high = spring("K3", 0.9, 1);
  high.largest         = 2.1;
  EXPECT_TRUE(leaves_samples(high));
}

TEST(CurveStudy, TheLeastForceParts)
{
  NonlinearRecord record;
  EXPECT_EQ(first_to_part(record), nullptr);
  record.modes = {mode(0.1, not_given), mode(-0.01, 3e4), mode(1e-4, 2e4), mode(not_given, 5e4)};
  EXPECT_EQ(first_to_part(record), &record.modes[2]);
  EXPECT_TRUE(bends(record.modes[1]));
  EXPECT_FALSE(bends(record.modes[2]));
  EXPECT_FALSE(bends(record.modes[3])) << "no spring parts";
}

TEST(CurveStudy, CurvesUnderASmallForceAreLinearSprings)
{
  const auto chain = chain_on_curves(1e6, 0.02);
  DrivenCurves drive{chain.stand, chain.modal, std::vector<NonlinearSpring>(chain.stand.laws.size()), 200};
  ForceRecord force;
  force.time        = Eigen::VectorXd::LinSpaced(401, 0, 0.2);
  force.force       = 1e6 + 1e3 * (2 * M_PI * 50 * force.time.array()).sin();
  const auto runs   = curve_runs(drive, driven_model(chain.modal), force, 5e3);
  const auto record = curve_study(drive, runs, force, 5e3);
  EXPECT_TRUE(near(record.force_range, 2e3, within(1e-3, "a sine, eight samples a quarter")));
  EXPECT_TRUE(near(record.duration, 0.2, within(1e-12, "as made")));
  ASSERT_EQ(record.rolls.size(), 2u);
  for (const NonlinearRoll &roll : record.rolls)
    EXPECT_TRUE(near(roll.rms, roll.linear_rms, within(2e-3, "a thousandth of the load at rest")));
  const auto verdict = linear_verdict(record);
  EXPECT_TRUE(verdict.enough);
  ASSERT_NE(verdict.softest, nullptr);
  EXPECT_GT(verdict.softest->least, 0.98);
  EXPECT_GT(record.scale_to_part, 50);
}
