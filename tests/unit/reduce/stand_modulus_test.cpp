// Numbers of the mill modulus and their errors, from springs whose sums are known in closed form.
#include "reduce/chain/contact_stiffness.h"
#include "reduce/stand/six_masses.h"
#include "reduce/stand/stand_modulus.h"
#include "tests/support/beam_demo.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::reduce;

namespace {
constexpr double load = 976.2e3, K = 5e9, a = 3e-9, n = 0.86;
const auto series = within(1e-12, "sum of reciprocals in another order");

double power_law(const double force)
{
  return a * std::pow(force, n);
}

SpringAtForce stiffening(const double force)
{
  return {force / (n * power_law(force)), force / power_law(force)};
}

// A spring K and one that deflects by a F^n.
std::vector<PathSpring> stiffening_path()
{
  const auto now = stiffening(load);
  return {{{"K1", K, K, 0.01, {}}, {}}, {{"K_ww", now.tangent, now.secant, 0.02, {}}, stiffening}};
}

Parameter spring_of(const double value)
{
  Parameter p;
  p.value = value;
  return p;
}
}  // namespace

TEST(StandModulus, IsThatOfTheStretch)
{
  const auto path = stiffening_path();
  const auto m    = path_modulus(path, path, Frame(), load, {});
  const double d  = load / K + power_law(load);
  EXPECT_TRUE(near(m.modulus.secant, load / d, series));
  EXPECT_TRUE(near(m.modulus.tangent, 1 / (1 / K + n * power_law(load) / load), series));
  EXPECT_TRUE(near(m.by_differences, m.modulus.tangent, within(1e-5, "central difference, step of 2 %")));
  EXPECT_TRUE(near(m.by_tangents, m.modulus.secant, within(1e-8, "Simpson's rule, 64 steps")));
  ASSERT_EQ(m.stretch.load.size(), 41);
  EXPECT_EQ(m.stretch.load[0], 0.1 * load);
  EXPECT_EQ(m.stretch.load[40], 2 * load);
  for (const Eigen::Index i : {0, 17, 40}) {
    const double F = m.stretch.load[i];
    EXPECT_TRUE(near(m.stretch.deflection[i], F / K + power_law(F), series)) << F;
    EXPECT_TRUE(near(1 / m.stretch.tangent[i], 1 / K + n * power_law(F) / F, series)) << F;
  }
}

TEST(StandModulus, ErrorIsThatOfTheSpringsOrOfTheMeasuredModulus)
{
  const auto touching             = stiffening_path();
  std::vector<PathSpring> rolling = touching;
  rolling[1]                      = {{"K4.flattening", 8e9, 8e9, 0.1, {}}, {}};
  rolling.push_back({{"K_bend", 3e10, 3e10, 0.05, {}}, {}});
  Frame frame;
  const auto free = path_modulus(rolling, touching, frame, load, {}).modulus;
  EXPECT_TRUE(near(free.error, free.tangent * (0.01 / K + 0.1 / 8e9 + 0.05 / 3e10), series)) << "(30.5)";
  frame.modulus          = 4e9;
  frame.modulus_error    = 0.03;
  frame.closing          = {"upper_post_stiffness"};
  rolling[0].error       = not_given;
  rolling[0].error_lacks = {"K1"};
  const auto measured    = path_modulus(rolling, touching, frame, load, {}).modulus;
  const double K_ww = stiffening(load).tangent, closed = 1 / (1 / K + 1 / K_ww);
  EXPECT_TRUE(
      near(measured.error, measured.tangent * (0.03 / closed + 0.02 / K_ww + 0.1 / 8e9 + 0.05 / 3e10), series))
      << "(30.12)";
  EXPECT_TRUE(measured.lacks.empty()) << "what K1 lacks does not matter";
  EXPECT_TRUE(near(path_modulus(touching, touching, frame, load, {}).modulus.error, 0.03, series));
}

TEST(StandModulus, BearingsDeflectAlongTheirCurve)
{
  LoadDeflection curve{Eigen::Vector3d(1e5, 5e5, 2e6), Eigen::VectorXd(3), Eigen::VectorXd(3)};
  for (Eigen::Index i = 0; i < 3; ++i) {
    curve.deflection[i] = power_law(curve.load[i]);
    curve.tangent[i]    = stiffening(curve.load[i]).tangent;
  }
  const auto now    = stiffening(load);
  const double K2   = 1 / (1 / K + 1 / now.tangent);
  const auto spring = spring_with_bearings({"K2", K2, K2, 0, {}}, now.tangent, now.secant, &curve);
  EXPECT_TRUE(near(spring.secant, 1 / (1 / K + power_law(load) / load), series));
  const auto half = spring.at_others(load / 2);
  EXPECT_TRUE(near(half.secant, 1 / (1 / K + 2 * power_law(load / 2) / load), series));
  EXPECT_TRUE(near(half.tangent, 1 / (1 / K + 2 * n * power_law(load / 2) / load), series));
  EXPECT_FALSE(spring_with_bearings({"K2", K2, K2, 0, {}}, now.tangent, now.secant, nullptr).at_others);
}

TEST(StandModulus, StretchKeepsToTheSamplesOfTheContacts)
{
  ContactCurve upper, lower;
  upper.load         = Eigen::Vector2d(2e5, 3e6);
  lower.load         = Eigen::Vector2d(5e4, 1.5e6);
  const auto path    = stiffening_path();
  const auto stretch = path_modulus(path, path, Frame(), load, {&upper, &lower}).stretch;
  EXPECT_EQ(stretch.load[0], 2e5);
  EXPECT_EQ(stretch.load[40], 1.5e6);
}

// A line contact has F (c0 - c1 ln F) as its approach, which the fit of the samples takes up exactly; outside of
// the samples it refuses.
TEST(StandModulus, DifferencesStayWithinTheSamplesOfTheContacts)
{
  const double c0 = 4e-10, c1 = 2e-11;
  const auto contact_on = [&](const double low, const double high) {
    ContactCurve curve;
    curve.load     = Eigen::VectorXd::LinSpaced(7, low, high);
    curve.approach = curve.load.array() * (c0 - c1 * (curve.load.array() / load).log());
    return curve;
  };
  const auto modulus_on = [](const ContactCurve &upper, const ContactCurve &lower) {
    std::vector<PathSpring> path{{{"K1", K, K, 0.01, {}}, {}}};
    for (const ContactCurve *curve : {&upper, &lower}) {
      const auto now = contact_stiffness(*curve, load);
      path.push_back({{"K3", now.tangent, now.secant, 0.02, {}}, [curve](const double force) {
                        const auto there = contact_stiffness(*curve, force);
                        return SpringAtForce{there.tangent, there.secant};
                      }});
    }
    return path_modulus(path, path, Frame(), load, {&upper, &lower});
  };
  const double modulus = 1 / (1 / K + 2 * (c0 - c1));
  const auto wide      = contact_on(100e3, 2000e3);
  const auto parabola =
      within(1e-5, "third derivative c1 / load^2 of the stretch, steps of at most 2 % of the load");
  for (const auto &[low, high] :
       {std::pair{100e3, 980e3}, {100e3, load}, {970e3, 2000e3}, {load, 2000e3}, {970e3, 980e3}}) {
    EXPECT_TRUE(near(modulus_on(contact_on(low, high), wide).by_differences, modulus, parabola))
        << low << " " << high;
    EXPECT_TRUE(near(modulus_on(wide, contact_on(low, high)).by_differences, modulus, parabola))
        << low << " " << high;
  }
  const auto no_stretch = modulus_on(contact_on(100e3, load), contact_on(load, 2000e3));
  EXPECT_TRUE(std::isnan(no_stretch.by_differences)) << "both contacts have samples at this one load only";
  EXPECT_TRUE(near(no_stretch.modulus.tangent, modulus, within(1e-9, "fit of the contacts, rounding")));
}

TEST(StandModulus, TouchingRollsFollowHertzAndTheirErrorIsThatOfK3)
{
  const FourHigh stand = demo_drawing();
  const auto rolls     = touching_work_rolls(stand, load, 0.07);
  EXPECT_TRUE(near(rolls.by_differences, rolls.contact.tangent, within(1e-5, "central difference, 1 %")));
  EXPECT_EQ(rolls.error, 0.07);
  EXPECT_TRUE(near(touching_work_rolls(stand, load, not_given).error,
                   std::abs(rolls.laws.palmgren / rolls.laws.johnson - 1), series));
}

TEST(StandModulus, BendingIsTheSumOfItsSlopeOverTheWidth)
{
  FourHigh stand                = demo_drawing();
  stand.dynamics.mass_reference = MassReference::mid;
  const double barrel           = stand.work_roll.barrel_length;
  const auto bending            = [&](const double width) {
    stand.strip.width = width;
    return bending_spring(stand, {}, spring_of(4e10), spring_of(4e10));
  };
  EXPECT_FALSE(bending(barrel).bends) << "an even load does not bend the roll";
  EXPECT_EQ(bending(barrel).by_width, 0);
  const double narrow = 0.6 * barrel, wide = 0.9 * barrel, h = (wide - narrow) / 20;
  double sum = 0;  // Simpson's rule
  for (int i = 0; i <= 20; ++i)
    sum += h / 3 * (i == 0 || i == 20 ? 1 : i % 2 ? 4 : 2) * bending(narrow + i * h).by_width;
  const auto spring = bending(narrow);
  EXPECT_TRUE(near(sum, bending(wide).compliance - spring.compliance,
                   within(1e-3, "each slope by a central difference of 1 %")));
  EXPECT_LT(sum, 0);
  EXPECT_TRUE(near(spring.beam * spring.compliance, 1, series)) << "no rolls by finite elements";
  EXPECT_TRUE(std::isnan(spring.error));
}

TEST(StandModulus, GapOfAChainOpensByItsSpringsInSeries)
{
  const LumpedModel chain = demo_chain(demo_drawing()).model;
  double sum              = 0;
  for (const std::size_t i : {0, 1, 2, 4, 5, 6})
    sum += 1 / chain.K[i].value;
  for (const MassReference reference : every<MassReference>())
    EXPECT_TRUE(near(gap_opening(chain_stand(chain), reference), sum, within(1e-9, "solved as a system")));
}
