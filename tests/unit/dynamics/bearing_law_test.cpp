#include "core/base/errors.h"
#include "dynamics/bearing/law.h"
#include "tests/support/near.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;
using namespace mill::dynamics;
using Eigen::VectorXd;

namespace {
constexpr double k = 2e13, n = 10.0 / 9;  // N/m^n, the size of a mill bearing

BearingCurve power_curve(const double clearance, const double exponent = n)
{
  const VectorXd depth = VectorXd::LinSpaced(4, std::log(5e-6), std::log(2e-4)).array().exp();
  BearingCurve curve;
  curve.displacement = depth.array() + clearance;
  curve.force        = k * depth.array().pow(exponent);
  curve.tangent      = exponent * k * depth.array().pow(exponent - 1);
  return curve;
}

const Tolerance rounding = within(1e-12, "logarithm and exponential of numbers near 1e13, some ten roundings");

std::string message_of(const BearingCurve &curve)
{
  try {
    bearing_law(curve);
  } catch (const InputError &error) {
    return error.what();
  }
  return "";
}
}  // namespace

// A power law is a straight line in the logarithms, so four samples are as good as a thousand.
TEST(BearingLaw, ReproducesAPowerLawEverywhere)
{
  for (const double clearance : {0.0, 5e-5}) {
    BearingCurve curve   = power_curve(clearance);
    const BearingLaw law = bearing_law(curve);
    EXPECT_TRUE(near(law.clearance, clearance, within(1e-10, "difference of two numbers of its size", 5e-5)))
        << "found from the first sample when the case does not state it";
    curve.clearance         = clearance;
    const BearingLaw stated = bearing_law(curve);
    EXPECT_FALSE(stated.limited);
    for (const double depth : {1e-9, 1e-6, 5e-6, 2.2e-5, 9e-5, 2e-4}) {
      const double e            = clearance + depth - clearance;  // what a double keeps of it
      const ForceAndSlope force = force_at(stated, clearance + depth);
      EXPECT_TRUE(near(force.force, k * std::pow(e, n), rounding)) << depth;
      EXPECT_TRUE(near(force.tangent, n * k * std::pow(e, n - 1), rounding)) << depth;
    }
    EXPECT_EQ(force_at(stated, clearance).force, 0);
    EXPECT_EQ(force_at(stated, 0.5 * clearance).tangent, 0) << "nothing pulls inside the clearance";
  }
}

// Force and slope have no jump: not at the samples, not at the ends, whatever the start is.
TEST(BearingLaw, SlopeIsTheDerivativeAndHasNoJump)
{
  for (const double exponent : {0.8, 1.0, n, 2.3}) {
    BearingCurve curve = power_curve(1e-5, exponent);
    curve.clearance    = 0;  // not where the samples come from, so that the exponent changes from one to the next
    const BearingLaw law = bearing_law(curve);
    for (double d = 2e-6; d < 3e-4; d *= 1.1) {
      const double h          = 1e-5 * d;
      const double difference = (force_at(law, d + h).force - force_at(law, d - h).force) / (2 * h);
      EXPECT_TRUE(near(force_at(law, d).tangent, difference,
                       within(2e-5, "a sample may lie inside the difference, where the second derivative jumps")))
          << exponent << " at " << d;
    }
    for (Eigen::Index i = 0; i < curve.force.size(); ++i) {
      const ForceAndSlope before = force_at(law, curve.displacement[i] * (1 - 1e-12)),
                          after  = force_at(law, curve.displacement[i] * (1 + 1e-12));
      EXPECT_TRUE(near(before.force, curve.force[i], within(1e-10, "one step of 1e-12 aside")));
      EXPECT_TRUE(near(before.tangent, after.tangent, within(1e-9, "two steps of 1e-12 apart")));
      EXPECT_TRUE(near(after.tangent, curve.tangent[i], within(1e-9, "the slopes given are met")));
    }
  }
}

// A preloaded bearing grows softer as rollers come free; its force starts from zero with a slope, both ways alike.
TEST(BearingLaw, PreloadedBearingStartsWithAFiniteSlope)
{
  BearingCurve curve;
  curve.clearance      = 0;
  curve.displacement   = Eigen::Vector2d(1e-5, 4e-5);
  curve.force          = Eigen::Vector2d(4e5, 1.2e6);
  curve.tangent        = Eigen::Vector2d(3.2e10, 2.4e10);  // exponents 0.8 and 0.8
  const BearingLaw law = bearing_law(curve);
  // a + b e^2 through value and slope of the first sample: a = (3 - 0.8)/2 = 1.1 of the first secant
  EXPECT_TRUE(near(force_at(law, 1e-12).tangent, 1.1 * 4e10, within(1e-9, "e^2 = 1e-14 compared with one")));
  EXPECT_TRUE(near(force_at(law, 1e-5).tangent, 3.2e10, within(1e-12, "the slope given")));
}

TEST(BearingLaw, ForceNeverFallsHoweverTheSlopesAre)
{
  BearingCurve curve;
  curve.clearance      = 0;
  curve.displacement   = Eigen::Vector4d(1e-5, 2e-5, 3e-5, 1e-4);
  curve.force          = Eigen::Vector4d(1e5, 1.01e5, 5e5, 6e5);
  curve.tangent        = Eigen::Vector4d(4e10, 9e10, 1e9, 2e11);
  const BearingLaw law = bearing_law(curve);
  EXPECT_TRUE(law.limited);
  double last = 0;
  for (double d = 1e-7; d < 2e-4; d += 1e-7) {
    const double force = force_at(law, d).force;
    EXPECT_GE(force, last * (1 - 1e-14)) << d;
    last = force;
  }
  for (int i = 0; i < 4; ++i)
    EXPECT_TRUE(near(force_at(law, curve.displacement[i]).force, curve.force[i], rounding));
}

TEST(BearingLaw, DisplacementUnderALoadIsTheInverse)
{
  const BearingLaw law = bearing_law(power_curve(5e-5));
  for (const double load : {1e-3, 1e3, 4e7, 1e9, 9e9})
    EXPECT_TRUE(near(
        force_at(law, displacement_under(law, load)).force, load,
        within(1e-7, "a displacement of 5e-5 m is rounded to 7e-21 m, at 1 mN 4e-6 of the depth under it", 1e3)))
        << load;
  EXPECT_EQ(displacement_under(law, 0), law.clearance);
}

TEST(BearingLaw, RefusesWrongTablesWithTheReason)
{
  BearingCurve curve = power_curve(0);
  curve.force[2]     = curve.force[1];
  EXPECT_NE(message_of(curve).find("force of sample 3 is"), std::string::npos) << message_of(curve);
  curve            = power_curve(0);
  curve.tangent[0] = 0;
  EXPECT_NE(message_of(curve).find("tangent of sample 1 is 0 N/m"), std::string::npos) << message_of(curve);
  curve           = power_curve(0);
  curve.clearance = 6e-6;
  EXPECT_NE(message_of(curve).find("clearance 6 um has to lie between zero and the displacement 5 um"),
            std::string::npos)
      << message_of(curve);
  curve         = power_curve(0);
  curve.tangent = VectorXd::Ones(2);
  EXPECT_NE(message_of(curve).find("4 displacements, 4 forces and 2 tangents"), std::string::npos)
      << message_of(curve);
  EXPECT_THROW(bearing_law({}), InputError);
}
