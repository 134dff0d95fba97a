#include "core/base/errors.h"
#include "reduce/chain/contact_stiffness.h"
#include "tests/support/near.h"
#include <cmath>
#include <functional>
#include <string>

using namespace mill;
using reduce::contact_stiffness;

namespace {
ContactCurve curve_of(const std::function<double(double)> &approach, const int n = 24, const double low = 100e3,
                      const double high = 2000e3)
{
  ContactCurve curve;
  curve.name = "upper";
  curve.load = Eigen::VectorXd::LinSpaced(n, std::log(low), std::log(high)).array().exp();
  curve.approach.resize(n);
  for (int i = 0; i < n; ++i)
    curve.approach[i] = approach(curve.load[i]);
  return curve;
}

/// Johnson's line contact of the demo rolls, written out: delta = A q (ln(16 R1 R2 / a^2) - 1).
double johnson(const double load)
{
  const double E = 210e9, nu = 0.28, R1 = 0.210, R2 = 0.725, length = 1.4;
  const double A = 2 * (1 - nu * nu) / (M_PI * E), q = load / length;
  const double a2 = 4 * q * A * R1 * R2 / (R1 + R2);
  return A * q * (std::log(16 * R1 * R2 / a2) - 1);
}
}  // namespace

TEST(ContactStiffness, ExactOnTheExactCurve)
{
  const auto k = contact_stiffness(curve_of(johnson), 976217.5);
  EXPECT_TRUE(near(k.tangent, 40191831577.7,
                   within(1e-11, "the fit contains the exact curve; reference printed with twelve digits")));
  EXPECT_TRUE(near(k.secant, 37207522439.19, within(1e-11, "as the tangent")));
  EXPECT_LT(k.fit_error, 1e-12);
}

// A curve the form does not contain: delta ~ F^0.9 (Palmgren).  Tangent / secant is 1/0.9 at every load.
TEST(ContactStiffness, FollowsASmoothCurveOfAnotherForm)
{
  const auto power = [](double F) { return 1.5e-11 * std::pow(F, 0.9) * std::pow(1e6, 0.1); };
  for (const double load : {100e3, 137e3, 500e3, 976217.5, 2000e3}) {
    const auto k = contact_stiffness(curve_of(power), load);
    // approach/F ~ exp(-0.1 u): the cubic term left out is 1e-3 u^3 / 6, with u up to 0.9 at the ends of the
    // sweep.
    EXPECT_TRUE(near(k.secant, load / power(load), within(1.3e-4, "cubic term at the farthest sample")));
    EXPECT_TRUE(near(k.tangent / k.secant, 1 / 0.9,
                     within(4e-4, "slope of the cubic term at the farthest sample, 5e-4 u^2")));
  }
}

TEST(ContactStiffness, NeverExtrapolatesAndNamesTheKey)
{
  const auto curve = curve_of(johnson);
  EXPECT_NO_THROW(contact_stiffness(curve, 100e3));
  EXPECT_NO_THROW(contact_stiffness(curve, 2000e3));
  EXPECT_THROW(contact_stiffness(curve, 99e3), InputError);
  try {
    contact_stiffness(curve, 2.1e6);
    FAIL() << "extrapolated";
  } catch (const InputError &error) {
    EXPECT_STREQ(error.problems.at(0).message.c_str(),
                 "contact upper: the working load 2100 kN is outside the computed curve, "
                 "100 kN .. 2000 kN; widen contact.upper.loads");
  }
}

TEST(ContactStiffness, RefusesTooFewOrUnorderedSamples)
{
  EXPECT_THROW(contact_stiffness(curve_of(johnson, 4), 500e3), InputError);
  auto curve = curve_of(johnson);
  std::swap(curve.load[3], curve.load[4]);
  EXPECT_THROW(contact_stiffness(curve, 500e3), InputError);
  curve             = curve_of(johnson);
  curve.approach[7] = std::nan("");
  EXPECT_THROW(contact_stiffness(curve, 500e3), InputError);
}

// A lost node moves one sample by a percent: the fit must notice, not average.
TEST(ContactStiffness, ReportsACurveThatIsNoLineContact)
{
  auto curve = curve_of(johnson);
  for (int i = 0; i < curve.load.size(); ++i)
    if (curve.load[i] > 500e3)
      curve.approach[i] *= 1.01;
  EXPECT_THROW(contact_stiffness(curve, 500e3), SolverError);
}
