// Springs in series between the rolls, and a stand coupled with a strip.
#include "reduce/chain/line_contact.h"
#include "reduce/chain/mill_modulus.h"
#include "tests/support/beam_demo.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>

using namespace mill;
using namespace mill::reduce;

namespace {
const CylinderPair work_rolls{0.42, 0.42, 1.4, {2.1e11, 0.28, 7700}};
const CylinderPair with_backup{0.42, 1.45, 1.4, {2.1e11, 0.28, 7700}};
constexpr double load = 976.2e3;
const auto series     = within(1e-12, "sum of reciprocals in another order");

LoadDeflection power_law(const double a, const double n)
{
  LoadDeflection part{Eigen::Vector4d(1e4, 5e4, 3e5, 2e6), Eigen::VectorXd(4), Eigen::VectorXd(4)};
  for (Eigen::Index i = 0; i < 4; ++i) {
    part.deflection[i] = a * std::pow(part.load[i], n);
    part.tangent[i]    = part.load[i] / (n * part.deflection[i]);
  }
  return part;
}
}  // namespace

// PL-1
TEST(MillModulus, IsTheSeriesOfTheSpringsOfTheDemoStand)
{
  const LumpedModel model = demo_chain(demo_drawing()).model;
  const auto K            = [&](const int i) { return model.K[std::size_t(i - 1)].value; };
  const auto ww           = line_contact(work_rolls, load);
  std::vector<PathPart> path;
  for (const int i : {1, 2, 3, 5, 6, 7})
    path.push_back({"K" + std::to_string(i), K(i), K(i), 0.01, {}});
  path.push_back({"K_ww", ww.tangent, ww.secant, 0.02, {}});
  const MillModulus m  = mill_modulus(path);
  const double by_hand = 1 / (1 / K(1) + 1 / K(2) + 1 / K(3) + 1 / ww.tangent + 1 / K(5) + 1 / K(6) + 1 / K(7));
  EXPECT_TRUE(near(m.tangent, by_hand, series));
  EXPECT_TRUE(near(1 / m.secant, 1 / by_hand - 1 / ww.tangent + 1 / ww.secant, series));
  EXPECT_TRUE(near(m.error, 0.01 * (1 - by_hand / ww.tangent) + 0.02 * by_hand / ww.tangent, series))
      << "errors count with the share of the stretch";
  EXPECT_EQ(m.softest, "K1");
  EXPECT_LT(m.secant, m.tangent) << "a line contact stiffens";
}

TEST(MillModulus, AnUnknownErrorIsNotZero)
{
  const MillModulus m = mill_modulus({{"K1", 1e9, 1e9, not_given, {"frame.upper_post_stiffness_tolerance"}},
                                      {"K3", 2e9, 2e9, 0.1, {}},
                                      {"K7", 1e9, 1e9, not_given, {}}});
  EXPECT_TRUE(std::isnan(m.error));
  EXPECT_EQ(m.lacks, (std::vector<std::string>{"frame.upper_post_stiffness_tolerance", "K7"}));
  EXPECT_NE(refusal([] { mill_modulus({{"K2", 0, 0, 0, {}}}); }).find("K2 must be positive"), std::string::npos);
}

TEST(LoadDeflection, APowerLawIsExactBetweenAndBeyondItsSamples)
{
  const double a = 3e-9, n = 0.86;
  const LoadDeflection part = power_law(a, n);
  const auto exact          = within(1e-12, "the interpolation is exact for a power law");
  for (const double F : {2e3, 1e4, 2.3e4, 5e4, 1e6, 2e6, 7e6}) {
    const Deflected d = deflected_at(part, F);
    EXPECT_TRUE(near(d.deflection, a * std::pow(F, n), exact)) << F;
    EXPECT_TRUE(near(d.compliance, n * a * std::pow(F, n - 1), exact)) << F;
  }
  EXPECT_NE(refusal([&] { deflected_at(part, 0); }), "");
}

TEST(LoadDeflection, SlopeIsThatOfTheInterpolationAndALineContactIsMet)
{
  LoadDeflection part{Eigen::VectorXd(9), Eigen::VectorXd(9), Eigen::VectorXd(9)};
  for (Eigen::Index i = 0; i < 9; ++i) {
    part.load[i]       = 1e5 * std::pow(20., double(i) / 8);
    const auto c       = line_contact(with_backup, part.load[i]);
    part.deflection[i] = c.approach;
    part.tangent[i]    = c.tangent;
  }
  for (const double F : {1.3e5, 4.4e5, 9.7e5, 1.9e6}) {
    const double h = 1e-4 * F, up = deflected_at(part, F + h).deflection,
                 down = deflected_at(part, F - h).deflection;
    const Deflected d = deflected_at(part, F);
    EXPECT_TRUE(near(d.compliance, (up - down) / (2 * h), within(1e-7, "central difference, step 1e-4")));
    EXPECT_TRUE(
        near(d.deflection, line_contact(with_backup, F).approach, within(1e-7, "cubic in the logarithms")));
  }
}

TEST(WorkRollBending, VanishesUnderAStripAsWideAsTheBarrel)
{
  const double K = 4e10, L = 1.4;
  const auto roll = [&](const double strip) {
    return BentWorkRoll(foundation_shape({L / 2, strip / 2, K / L, 2.1e11 * M_PI * std::pow(0.42, 4) / 64}));
  };
  for (const MassReference reference : every<MassReference>()) {
    EXPECT_TRUE(
        near(work_roll_bending(roll(1.4), K, L / 2, reference) * K, 0,
             within_absolute(1e-9, "an even load does not bend the roll; rounding times a stiffness of 4e10")));
    EXPECT_GT(work_roll_bending(roll(1.0), K, L / 2, reference), 0);
    EXPECT_GT(work_roll_bending(roll(0.6), K, L / 2, reference),
              work_roll_bending(roll(1.0), K, L / 2, reference));
  }
  EXPECT_TRUE(
      near(work_roll_bending(roll(1), K, L / 2, MassReference::mid), roll(1).deflection(0) - 1 / K, series));
  EXPECT_LT(work_roll_bending(roll(1), K, L / 2, MassReference::mean),
            work_roll_bending(roll(1), K, L / 2, MassReference::mid));
}

// PL-2 with a force in closed form; that of a slab theory stands in tests/unit/app/gauge_test.cpp.
TEST(GaugeCoupling, IsTheDifferenceOfTheCoupledSolution)
{
  const double h1 = 8e-3, h2 = 5e-3, K = 6e9;
  const auto force = [](const double in, const double out) {
    return 1.1e7 * std::sqrt(in - out) * (1 + 40 * (in - out)) / std::sqrt(out / 5e-3);
  };
  const auto stretch = [&](const double F) { return F / K + 2 * line_contact(with_backup, F).approach; };
  const double F = force(h1, h2), S = h2 - stretch(F), d = 1e-7;
  const auto rolled = [&](const double screw, const double in) {
    return coupled_thickness(
        screw, [&](const double out) { return force(in, out); }, stretch, 0.9 * h2, 1.1 * h2);
  };
  const double e = 1e-10;  // exact slopes of the force by differences in five digits more than are compared
  const auto by  = [&](const double in, const double out) {
    return (force(h1 + in, h2 + out) - force(h1 - in, h2 - out)) / (2 * (in + out));
  };
  const GaugeCoupling gauge{1 / (1 / K + 2 / line_contact(with_backup, F).tangent), -by(0, 1e4 * e)};
  const auto differences = within(1e-6, "central differences");
  EXPECT_TRUE(near(rolled(S, h1), h2, within(1e-13, "the same state")));
  EXPECT_TRUE(near(gauge.screw(), (rolled(S + d, h1) - rolled(S - d, h1)) / (2 * d), differences));
  EXPECT_TRUE(
      near(gauge.thickness_by(by(1e4 * e, 0)), (rolled(S, h1 + d) - rolled(S, h1 - d)) / (2 * d), differences));
  const auto carried = [&](const double screw, const double in) { return force(in, rolled(screw, in)); };
  EXPECT_TRUE(
      near(gauge.force_by(by(1e4 * e, 0)), (carried(S, h1 + d) - carried(S, h1 - d)) / (2 * d), differences));
  EXPECT_TRUE(near(gauge.force_by_screw(), (carried(S + d, h1) - carried(S - d, h1)) / (2 * d), differences));
  EXPECT_NE(refusal([&] { rolled(S + 1, h1); }), "");
}
