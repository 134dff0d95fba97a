#include "fem/roll/contact_details.h"
#include "fem/roll/contact_numbers.h"
#include "fem/roll/contact_slope.h"
#include "tests/support/closed_form.h"
#include "tests/support/near.h"
#include "tests/support/roll_pair.h"
#include <algorithm>
#include <cmath>

// Two long rolls as slabs of one metre: what is read off a contact is that of Hertz's line contact.
using namespace mill;

namespace {
constexpr double D1 = 0.4, D2 = 1.3, E = 210e9, nu = 0.3;
constexpr double q = 1000e3;  // N/m
const Material steel{E, nu, 7700};

closed_form::Line hertz(const double load)
{
  return closed_form::line_contact(load, D1, D2, E, nu);
}

fem::ContactPair slabs(const int per_half_width)
{
  const double b = hertz(q).half_width;
  return slab_pair(meshed_slab("upper", D1, b, 1.6 * b, per_half_width, D1 / 20, steel),
                   meshed_slab("lower", D2, b, 1.6 * b, per_half_width, D1 / 20, steel));
}

struct Contact {
  fem::ContactPairs pairs;
  fem::ContactCurves curves;
};

// Slabs have no necks: "in the stand" is the same pair.
Contact made_contact()
{
  Contact c;
  c.pairs.closed_form = {D1, D2, 1, steel};
  c.pairs.mirrored = c.pairs.in_stand = slabs(8);
  c.pairs.coarse = c.pairs.in_stand_coarse = slabs(4);
  const auto loads                         = fem::log_spaced(0.5 * q, 2 * q, 12);
  c.curves.mirrored = c.curves.in_stand = fem::sweep(c.pairs.mirrored, loads);
  c.curves.coarse = c.curves.in_stand_coarse = fem::sweep(c.pairs.coarse, loads);
  return c;
}

const Contact &contact_of_slabs()
{
  static const Contact made = made_contact();
  return made;
}

BarrelProfile uniform(const Eigen::VectorXd &z, const double line_load)
{
  BarrelProfile p;
  p.z          = z;
  p.line_load  = Eigen::VectorXd::Constant(z.size(), line_load);
  p.half_width = Eigen::VectorXd::Constant(z.size(), 1e-3);
  return p;
}
}  // namespace

TEST(ContactNumbers, CurvatureOfALineContactIsTheSlopeOfItsTangent)
{
  const double step  = 1e-4 * q;
  const double slope = (hertz(q + step).tangent - hertz(q - step).tangent) / (2 * step);
  EXPECT_TRUE(near(fem::line_contact_curvature(reduce::line_contact({D1, D2, 1, steel}, q), q),
                   slope * hertz(q).tangent, within(1e-6, "central difference of the closed form")));
}

TEST(ContactNumbers, StiffnessOfSlabsIsThatOfHertz)
{
  const auto &[pairs, curves] = contact_of_slabs();
  const auto k                = fem::stiffness_at(pairs, curves, q);
  const double tangent = hertz(q).tangent, secant = q / hertz(q).approach;
  EXPECT_TRUE(near(k.tangent.value, tangent, within(0.005, "8 elements per half width, fitted")));
  EXPECT_TRUE(near(k.secant.value, secant, within(0.003, "8 elements per half width")));
  EXPECT_TRUE(near(k.hertz.tangent, tangent, within(1e-12, "the same formula, written apart")));
  EXPECT_TRUE(near(k.middle_secant, k.secant.value, within(1e-6, "every section is the same")));
  EXPECT_FALSE(k.open_at_middle);
  EXPECT_EQ(k.in_stand_tangent.value, k.tangent.value) << "the same pair";
  EXPECT_TRUE(std::isnan(k.tangent.second)) << "the Fourier engine was not asked";
}

TEST(ContactNumbers, ErrorsOfAStiffnessAreTheLargestOfTheirComparisons)
{
  const auto &[pairs, curves] = contact_of_slabs();
  const auto k                = fem::stiffness_at(pairs, curves, q);
  const auto pair_error       = [](const fem::Compared &n) { return 1.25 * std::abs(n.coarse / n.value - 1); };
  EXPECT_TRUE(near(k.secant.error, pair_error(k.secant), within(1e-9, "two meshes, factor of safety 1.25")));
  EXPECT_TRUE(near(k.tangent.error, std::max(pair_error(k.tangent), std::abs(k.exact / k.tangent.value - 1)),
                   within(1e-9, "two meshes, or the active set of this one load")));
  // A second engine that is 10 % stiffer at every load.
  auto both           = curves;
  auto stiff          = curves.mirrored;
  stiff.approach      = stiff.approach / 1.1;
  const auto profile  = fem::barrel_profile(pairs.mirrored, fem::solve_load(pairs.mirrored, q));
  both.second         = {stiff, stiff, profile, profile};
  const auto by_two   = fem::stiffness_at(pairs, both, q);
  const auto in_tenth = within(1e-6, "every approach is a tenth smaller");
  EXPECT_TRUE(near(by_two.tangent.error, 0.1, in_tenth));
  EXPECT_TRUE(near(by_two.secant.error, 0.1, within(5e-3, "secant of the samples against that of the fit")));
  EXPECT_EQ(by_two.tangent.value, k.tangent.value);
  EXPECT_TRUE(near(by_two.in_stand_tangent.second, 1.1 * k.in_stand_tangent.value, in_tenth));
}

TEST(ContactNumbers, SlopeOfSamplesAloneIsThatOfTheCurve)
{
  const auto &[pairs, curves] = contact_of_slabs();
  const auto k = fem::slope_of(curves.mirrored, q), with_pair = fem::slope_at(pairs.mirrored, curves.mirrored, q);
  EXPECT_EQ(k.tangent, with_pair.tangent);
  EXPECT_TRUE(std::isnan(k.exact));
}

TEST(ContactNumbers, SectionOfSlabsIsThatOfHertz)
{
  const auto &[pairs, curves] = contact_of_slabs();
  const auto s                = fem::section_at(pairs, curves, q);
  const auto fitted           = within(0.01, "fitted through 8 elements per half width");
  EXPECT_TRUE(near(s.half_width.value, hertz(q).half_width, fitted));
  EXPECT_TRUE(near(s.peak_pressure.value, hertz(q).peak_pressure, fitted));
  EXPECT_TRUE(near(s.approach.value, hertz(q).approach, within(0.003, "8 elements per half width")));
  EXPECT_TRUE(near(s.hertz.half_width, hertz(q).half_width, within(1e-12, "the same formula, written apart")));
  // (1.4): a parabola of half width and peak must carry the line load.
  const double misfit = std::abs(M_PI / 2 * s.half_width.value * s.peak_pressure.value / q - 1);
  EXPECT_GE(s.half_width.error, misfit * (1 - 1e-6));
  EXPECT_GE(s.peak_pressure.error, misfit * (1 - 1e-6));
  EXPECT_TRUE(std::isnan(s.line_load_spread)) << "one engine";
}

TEST(ContactNumbers, SpreadOfTheLineLoadIsOverTheLargestAndLeavesTheEndsOut)
{
  const auto z       = Eigen::VectorXd::LinSpaced(71, -0.7, 0.7);
  const auto second  = uniform(z, 1000);
  auto first         = uniform(z, 980);
  first.line_load[0] = first.line_load[70] = 5000;  // a sharp barrel end
  EXPECT_TRUE(near(fem::line_load_spread(first, second), 0.02, within(1e-12, "20 of 1000 N/m")));
  first.line_load[35] = 1050;
  EXPECT_TRUE(near(fem::line_load_spread(first, second), 0.05, within(1e-12, "50 of 1000 N/m at one station")));
}

TEST(ContactNumbers, SlabsTouchOverTheirWholeLength)
{
  const auto &pairs = contact_of_slabs().pairs;
  const auto touch  = fem::contact_length(pairs, q);
  EXPECT_TRUE(near(touch.length.value, 2 * pairs.in_stand.path.sum(), within(1e-12, "every station, both sides")));
  EXPECT_TRUE(touch.at_middle);
  EXPECT_LT(touch.length.error, 1e-9) << "no end of the contact between two stations";
}

TEST(ContactNumbers, PlateauOfAUniformContactIsItsSecant)
{
  const auto plateau = fem::plateau_at(contact_of_slabs().pairs, q, 0);
  ASSERT_TRUE(plateau);
  EXPECT_TRUE(near(plateau->path.mean, plateau->of_length,
                   within(1e-6, "force per length over approach is the same at every station")));
  EXPECT_TRUE(
      near(plateau->error, std::abs(plateau->coarse / plateau->path.mean - 1), within(1e-9, "two meshes")));
}

TEST(ContactNumbers, LargestPressureIsThatOfThePatch)
{
  const auto peak = fem::largest_pressure(contact_of_slabs().pairs, q);
  EXPECT_TRUE(near(peak.pressure.value, hertz(q).peak_pressure, within(0.05, "nodal, not fitted")));
  EXPECT_EQ(peak.mirrored, peak.pressure.value) << "the same pair";
}

TEST(ContactNumbers, FrictionMultipliesTheTangentAndAddsItsErrors)
{
  fem::ContactPairs pairs;  // the ratios are given, no pair is solved
  pairs.mirrored.solved = std::make_shared<fem::SolvedLoads>();
  pairs.coarse.solved   = std::make_shared<fem::SolvedLoads>();
  int asked             = 0;
  const auto solve      = [&](const fem::PairMesh mesh, const int steps) {
    ++asked;
    return fem::FrictionEffect{mesh == fem::PairMesh::fine ? 1.02 : steps == 10 ? 1.01 : 1.03, 0.5};
  };
  const fem::Compared tangent{4e10, 0.01, 4e10, 4e10};
  const auto k = fem::friction_at(pairs, 0.1, 1e6, 10, tangent, solve);
  EXPECT_TRUE(near(k.tangent, 4.08e10, within(1e-12, "4e10 times 1.02")));
  EXPECT_TRUE(near(k.error, 0.01 + 1.25 * 0.01 / 1.02 + (1.03 / 1.01 - 1),
                   within(1e-12, "tangent, mesh, load path added")));
  EXPECT_EQ(asked, 3);
  fem::friction_at(pairs, 0.1, 1e6, 10, tangent, solve);
  EXPECT_EQ(asked, 3) << "the pairs remember";
}

TEST(ContactNumbers, AQuarterHasNoOneSidedness)
{
  EXPECT_FALSE(fem::one_sidedness(contact_of_slabs().pairs, q));
}
