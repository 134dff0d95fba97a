// Linearity, levels, comparison with a measured record, the table that is written.
#include "core/base/errors.h"
#include "dynamics/response/response.h"
#include "dynamics/response/rolling_force.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "tests/support/reference.h"
#include <cmath>

using namespace mill;
using namespace mill::dynamics;

namespace {
ForceRecord noise(const double low, const double high)
{
  NoiseSettings settings;
  settings.range    = {low, high};
  settings.duration = 1;
  return synthetic_force(settings);
}

MillModel model_of(const char *set)
{
  const auto chosen = parameter_set(set);
  return mill_model(chosen.stand, chosen.dynamics);
}
}  // namespace

TEST(Response, IsLinearInTheFluctuation)
{
  const ForceRecord once = noise(972898, 979537);
  ForceRecord twice      = once;
  twice.force            = once.force.array() + (once.force.array() - once.force.mean());
  for (const char *set : {"P1", "P3", "R1", "R2"}) {
    const Eigen::MatrixXd one = mill_response(model_of(set), once, 20e3).acceleration;
    const Eigen::MatrixXd two = mill_response(model_of(set), twice, 20e3).acceleration;
    // the fluctuation itself is a difference of forces 300 times larger: 300 eps = 7e-14 per sample
    EXPECT_LT((two - 2 * one).cwiseAbs().maxCoeff(), 1e-11 * two.cwiseAbs().maxCoeff()) << set;
  }
}

TEST(Response, TwoPassesWithOneHistoryDifferByTheRangeOfTheForce)
{
  const auto range    = reference("published.force_range").get<std::vector<std::vector<double>>>();
  const double width1 = range[0][1] - range[0][0], width2 = range[1][1] - range[1][0];
  const auto pass1 = noise(range[0][0], range[0][1]), pass2 = noise(range[1][0], range[1][1]);
  for (const char *set : {"P2", "Q1", "R1"})
    for (const Mass roll : {upper_work_roll, lower_work_roll}) {
      const Level one = level(mill_response(model_of(set), pass1, 20e3).acceleration.col(roll));
      const Level two = level(mill_response(model_of(set), pass2, 20e3).acceleration.col(roll));
      EXPECT_TRUE(near(two.peak / one.peak, width2 / width1, within(1e-10, "linearity"))) << set;
      EXPECT_TRUE(near(two.rms / one.rms, width2 / width1, within(1e-10, "linearity"))) << set;
    }
}

TEST(Response, AForceStepGivesForceOverMassAtOnce)
{
  ForceRecord step;
  step.time               = Eigen::Vector4d(0, 0.01, 0.01 + 1e-9, 0.02);
  step.force              = Eigen::Vector4d(1e6, 1e6, 1e6 + 1000, 1e6 + 1000);
  const Response response = mill_response(model_of("R1"), step, 1e3);
  EXPECT_TRUE(near(response.acceleration(9, upper_work_roll), 0,
                   within(1e-9, "m/s2: at rest before the step, rounding of 1e6 N over the mass", 1)));
  const Response fine = mill_response(model_of("R1"), step, 1e6);
  // Only the work rolls have started to move:  M y''' = -C y'' - K y',  so y'' = F/M (1 - C/M t - K/M t^2/2).
  const MillModel model = model_of("R1");
  const double t        = 1e-6;
  for (const Mass roll : {upper_work_roll, lower_work_roll}) {
    const double fade = model.C(roll, roll) * t + model.K(roll, roll) * t * t / 2;
    EXPECT_TRUE(near(fine.acceleration(10001, roll),
                     model.b[roll] * 1000 / model.M[roll] * (1 - fade / model.M[roll]),
                     within(1e-6, "the ramp of 1 ns is a thousandth of t, and the fade 2e-4")));
  }
}

TEST(Response, LoadCellRestsAtTheMeanForce)
{
  ForceRecord constant;
  constant.time           = Eigen::Vector2d(0, 0.1);
  constant.force          = Eigen::Vector2d(9e5, 9e5);
  const Response response = mill_response(model_of("R1"), constant, 1e3);
  EXPECT_EQ(response.time.size(), 101);
  EXPECT_TRUE(near(response.load_cell, Eigen::VectorXd::Constant(101, 9e5), within(1e-12, "nothing moves")));
  EXPECT_EQ(response.acceleration.cwiseAbs().maxCoeff(), 0);
}

TEST(Response, CriticalDampingUsesTheMatrixExponentialAndNotesIt)
{
  const auto critical = mill_model(published_stand(), settings(ForceMeaning::measured, 1));
  const auto force    = noise(972898, 979537);
  const Response fell = mill_response(critical, force, 20e3), plain = mill_response(model_of("R1"), force, 20e3);
  EXPECT_EQ(fell.form, HoldForm::matrix_exponential);
  EXPECT_EQ(fell.note,
            "repeated poles without independent shapes: integrated with the matrix exponential, not by modes");
  EXPECT_EQ(plain.form, HoldForm::modal);
  EXPECT_EQ(plain.note, "");
}

TEST(Response, ComparesOnTheTimeThatBothRecordsCover)
{
  const Response computed = mill_response(model_of("R1"), noise(972898, 979537), 20e3);
  MeasuredRecord measured;
  measured.time               = computed.time.tail(10001).array();  // 0.5 .. 1 s
  measured.upper_work_roll    = computed.acceleration.col(upper_work_roll).tail(10001) / 2;
  measured.lower_work_roll    = computed.acceleration.col(lower_work_roll).tail(10001) * 4;
  const Comparison comparison = compare(computed, measured);
  EXPECT_TRUE(near(comparison.begin, 0.5, within(1e-12, "first common sample")));
  EXPECT_TRUE(near(comparison.end, 1, within(1e-12, "last common sample")));
  EXPECT_TRUE(near(comparison.upper_work_roll.peak_ratio, 2, within(1e-12, "same record, halved")));
  EXPECT_TRUE(near(comparison.lower_work_roll.rms_ratio, 0.25, within(1e-12, "same record, four times")));
  EXPECT_TRUE(near(comparison.upper_work_roll.computed.peak,
                   computed.acceleration.col(upper_work_roll).tail(10001).cwiseAbs().maxCoeff(),
                   within(1e-15, "peak of the common part only")));
  measured.time.array() += 100;
  EXPECT_THROW(compare(computed, measured), InputError);
}

TEST(Response, TableHasAUnitInEveryColumn)
{
  const Response response = mill_response(model_of("R1"), noise(972898, 979537), 20e3);
  const Table table       = response_table(response);
  ASSERT_EQ(table.names.size(), 9u);
  EXPECT_EQ(table.names[1] + " [" + table.units[1] + "]", "upper_work_roll [g]");
  EXPECT_EQ(table.names[8] + " [" + table.units[8] + "]", "load_cell [kN]");
  EXPECT_EQ(table.columns[1][777], response.acceleration(777, upper_work_roll) / 9.80665);
  EXPECT_EQ(table.columns[7][777], response.force[777] / 1e3);
}

TEST(OutputRate, WarnsBelowTwentyPointsPerPeriod)
{
  EXPECT_FALSE(output_rate_warning(20e3, 745.8));
  EXPECT_EQ(text_of(output_rate_warning(20e3, 3679.2).value()),
            "output_rate = 20 kHz gives 5.44 points per period of the highest mode (3679 Hz): its peaks may be "
            "seen up to 16 % low; 74 kHz would show them");
}
