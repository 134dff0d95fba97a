// Numbers of a bearing between rigid rings whose rollers follow Palmgren's power law: closed forms of Stribeck.
#include "reduce/bearing/bearing_numbers.h"
#include "tests/support/demo_bearing.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::bearing;

namespace {
constexpr double stribeck = 4.0847;    // heaviest roller over the mean of a row, line contacts without clearance
constexpr double part_of_slope = 0.9;  // a stiffness under one load goes with the constant of the law to the 9/10

// Rollers without taper, for which every contact angle closes.
RollerBearing untapered(const double cup_angle_deg)
{
  RollerBearing b     = demo_bearing(cup_angle_deg);
  b.roller_cone_angle = 0;
  return b;
}

AssemblyState by_law(RollerBearing b, const OneRollerLaw law, const double factor = 1, const double cage = 0)
{
  b.roller_law       = law;
  BearingModel model = rigid_model(b);
  model.roller       = stiffened(model.roller, factor);
  model.cage_angle   = cage;
  return BearingAssembly(std::move(model)).solve(radial_drive(1e6));
}

ComparedStates demo_states(const RollerBearing &b, const double cage = 0)
{
  ComparedStates s;
  s.loading = radial_drive(1e6);
  s.at = s.palmgren = s.rigid = by_law(b, OneRollerLaw::palmgren, 1, cage);
  s.standard                  = by_law(b, OneRollerLaw::iso);
  return s;
}
}  // namespace

TEST(BearingNumbers, ArePalmgrensAndStribecks)
{
  for (const double angle : {0., 20.}) {
    const RollerBearing b  = untapered(angle);
    const BearingNumbers n = bearing_numbers(demo_states(b), {});
    const double cosine    = std::cos(b.cup_angle);
    EXPECT_TRUE(near(n.tangent.value / n.secant.value, 10. / 9, within(1e-9, "power law")));
    EXPECT_TRUE(near(n.roller_tangent.value / n.roller_secant.value, 10. / 9, within(1e-9, "power law")));
    EXPECT_TRUE(near(n.roller_max.value, stribeck * 1e6 / (4 * 39 * cosine), within(1e-3, "39 rollers")));
    EXPECT_TRUE(near(n.tangent.value, n.roller_tangent.value * 4 * 39 * cosine * cosine / stribeck,
                     within(1e-3, "39 rollers, (5.15)")));
    EXPECT_TRUE(near(n.tangent.standard / n.tangent.palmgren, std::pow(35948. / 37310, part_of_slope),
                     within(1e-4, "digits of the second constant")));
    ASSERT_EQ(n.row_share.size(), 4u);
    for (const ComparedNumber &share : n.row_share)
      EXPECT_TRUE(near(share.value, 0.25, within(1e-9, "rows that carry alike")));
    EXPECT_TRUE(std::isnan(n.tangent.error)) << "nothing says what it is known to";
  }
}

// A load that turns takes a round ring with it: across the load the tangent is load over motion.  The law of a
// roller is steep where contact begins, therefore the mean over a turn of the cage by one pitch.
TEST(BearingNumbers, AcrossTheLoadTheTangentIsTheSecant)
{
  constexpr int n_cage = 16;
  double across = 0, secant = 0;
  for (int i = 0; i < n_cage; ++i) {
    const BearingNumbers n = bearing_numbers(demo_states(untapered(0), 2 * M_PI / 39 * i / n_cage), {});
    across += n.tangent_across.value / n_cage;
    secant += n.secant.value / n_cage;
  }
  EXPECT_TRUE(near(across, secant, within(5e-3, "16 places of 39 rollers")));
}

TEST(BearingNumbers, ErrorAddsCompanionsAndTheWorstSupport)
{
  const RollerBearing b = untapered(0);
  const auto stiffer    = [&](const double factor) {
    return StateVariant{"stiffer", by_law(b, OneRollerLaw::palmgren, factor)};
  };
  ComparedStates s       = demo_states(b);
  s.companions           = {stiffer(1.1), stiffer(1.05)};
  s.meshes               = 1;
  s.supports             = {stiffer(1.02), stiffer(1.2)};
  s.arrangements         = {stiffer(2)};
  const BearingNumbers n = bearing_numbers(s, {});
  const auto change      = [](const double factor) { return std::pow(factor, part_of_slope) - 1; };
  EXPECT_TRUE(near(n.secant.error, 1.25 * change(1.1) + change(1.05) + change(1.2), within(1e-8, "power law")));
  EXPECT_TRUE(near(n.tangent.error, n.secant.error, within(1e-8, "one power law")));
  EXPECT_TRUE(near(n.tangent.supports.at(1) / n.tangent.value - 1, change(1.2), within(1e-8, "power law")));
  EXPECT_TRUE(near(n.tangent.arrangements.at(0) / n.tangent.value - 1, change(2), within(1e-8, "power law")));
  EXPECT_TRUE(near(n.roller_max.error, 0, within_absolute(1e-8, "equilibrium decides the loads of all")));
  EXPECT_TRUE(std::isnan(n.axial_displacement.error)) << "a number that is zero";
}

TEST(BearingNumbers, EstimatedRollersAreTheDistanceOfTheCandidates)
{
  constexpr double degree_numbers = M_PI / 180;
  const std::vector<RollerCandidate> two{{39, 0, 0, 20 * degree_numbers, 0, 1},
                                         {41, 0, 0, 22 * degree_numbers, 0, 1.1}};
  const double angle = 1.1 * std::pow(std::tan(22 * degree_numbers) / std::tan(20 * degree_numbers), 1.9) - 1;
  EXPECT_TRUE(near(estimate_error(two, EstimatedPart::stiffness), 0.1, within(1e-12, "its meaning")));
  EXPECT_TRUE(near(estimate_error(two, EstimatedPart::rollers), 2. / 41, within(1e-12, "its meaning")));
  EXPECT_TRUE(near(estimate_error(two, EstimatedPart::angle), angle, within(1e-12, "its meaning")));
  EXPECT_EQ(estimate_error({}, EstimatedPart::rollers), 0);
  ComparedStates s = demo_states(untapered(20));
  s.companions     = {{"the same", s.at}};
  const auto n     = bearing_numbers(s, two);
  EXPECT_TRUE(near(n.tangent.error, 0.1, within(1e-12, "the companion changes nothing")));
  EXPECT_TRUE(near(n.axial.error, angle, within(1e-12, "the companion changes nothing")));
  EXPECT_TRUE(near(n.roller_max.error, 2. / 41, within(1e-12, "the companion changes nothing")));
  EXPECT_EQ(n.row_share[0].error, 0);
}

TEST(BearingNumbers, HeaviestRollersAreNextToTheLoad)
{
  const double pitch = 2 * M_PI / 39;
  const auto angle   = [&](const double cage) {
    return bearing_numbers(demo_states(untapered(0), cage), {}).heaviest_angle;
  };
  EXPECT_TRUE(near(angle(0.3 * pitch), 0.3 * pitch, within(1e-9, "geometry")));
  EXPECT_TRUE(near(angle(0.7 * pitch), 0.3 * pitch, within(1e-9, "geometry")));
}
