#include "core/base/errors.h"
#include "reduce/chain/beam_shapes.h"
#include "reduce/chain/equivalent_mass.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include <cmath>
#include <utility>

using namespace mill;
using namespace mill::reduce;

namespace {
const Material steel{2.1e11, 0.28, 7700};

SteppedBeam backup_roll(const bool shear)
{
  SteppedBeam beam{2.45 / 2, 0.7, 0.7, round_section(1.450, steel), round_section(0.950, steel)};
  if (!shear)
    beam.barrel.shear = beam.neck.shear = std::numeric_limits<double>::infinity();
  return beam;
}

/// Simply supported Euler beam of one section, half span 1, load over |x| <= c.
SteppedBeam uniform_beam(const double half_load)
{
  const BeamSection section{1, std::numeric_limits<double>::infinity()};
  return {1, 1, half_load, section, section};
}

double mass_ratio(const SteppedBeam &beam)
{
  const auto shape = [&](double x) { return deflection(beam, x); };
  const double c   = beam.half_load;
  return equivalent_mass(shape, {{0, c, 1}, {c, 1, 1}}, {}, deflection(beam, 0));  // half beam of mass 1
}

FoundationShape work_roll(const double strip_width)
{
  return foundation_shape({0.7, strip_width / 2, 2.8708451127e10, round_section(0.420, steel).bending});
}
}  // namespace

// Exact: 3968/7875 and 17/35 (Rayleigh, Theory of Sound, sections 181 and 182, with the static shapes).
TEST(EquivalentMass, UniformBeam)
{
  EXPECT_TRUE(
      near(mass_ratio(uniform_beam(1)), 3968.0 / 7875, within(1e-12, "polynomial shape, exact quadrature")));
  EXPECT_TRUE(near(mass_ratio(uniform_beam(1e-4)), 17.0 / 35,
                   within(1e-6, "the patch of 1e-4 span is not a point: error of order patch^2")));
  EXPECT_TRUE(near(reference("mass.uniform_load"), 3968.0 / 7875, within(1e-15, "same number")));
}

TEST(EquivalentMass, RigidShapeAndLumpsCountFully)
{
  const auto one = [](double) { return 3.0; };
  EXPECT_TRUE(near(equivalent_mass(one, {{0, 2, 5}}, {{7, 3.0}, {4, 1.5}}, 3.0), 5 * 2 + 7 + 1,
                   within(1e-14, "4 kg at half the way count a quarter")));
}

TEST(BackupShape, MeetsTheReference)
{
  for (const bool shear : {true, false}) {
    const SteppedBeam beam = backup_roll(shear);
    const std::string name = shear ? "backup_shape.shear." : "backup_shape.no_shear.";
    EXPECT_TRUE(near(1 / mid_flexibility(beam), reference(name + "K_ZW"), within(1e-8, "closed form")));
    const Eigen::VectorXd expected = reference_vector(name + "w_rel");
    for (int i = 0; i <= 10; ++i)
      EXPECT_TRUE(near(deflection(beam, i * beam.half_span / 10) / deflection(beam, 0), expected[i],
                       within(1e-8, "closed form", 1)));
  }
}

TEST(BackupShape, MeanReference)
{
  const SteppedBeam beam = backup_roll(true);
  EXPECT_TRUE(
      near(1 / mean_flexibility(beam), reference("demo.mean_reference").at("K_ZW"), within(1e-8, "closed form")));
  // The mean of the deflection under an even load, summed here by the midpoint rule.
  double sum  = 0;
  const int n = 2000;
  for (int i = 0; i < n; ++i)
    sum += deflection(beam, (i + 0.5) / n * beam.half_load) / n;
  EXPECT_TRUE(
      near(mean_flexibility(beam), sum, within(1e-6, "midpoint rule, error (1/n)^2 / 24 of the curvature")));
}

TEST(BackupShape, SymmetricAndSmoothAtTheSteps)
{
  SteppedBeam beam = backup_roll(true);
  beam.half_load   = 0.4;
  EXPECT_EQ(deflection(beam, 0.55), deflection(beam, -0.55));
  EXPECT_EQ(deflection(beam, beam.half_span), 0);
  for (const double x : {beam.half_load, beam.half_barrel})
    EXPECT_TRUE(near(deflection(beam, x - 1e-9), deflection(beam, x + 1e-9),
                     within(1e-8, "continuous; slope times 2 nm")));
}

TEST(WorkShape, MeetsTheReference)
{
  for (const auto &[width, name] : {std::pair{0.3, "work_shape.B_0.3"}, std::pair{1.0, "work_shape.B_1"},
                                    std::pair{1.4, "work_shape.B_1.4"}}) {
    const FoundationShape shape    = work_roll(width);
    const Eigen::VectorXd expected = reference_vector(name);
    const auto closed              = within(1e-8, "closed form, six linear equations");
    EXPECT_TRUE(near(deflection(shape, 0), expected[0], closed));
    EXPECT_TRUE(near(deflection(shape, 0.7), expected[1], closed));
    EXPECT_TRUE(near(deflection(shape, 1.0), expected[2], closed));
  }
}

// The foundation must carry the strip load: k times the integral of w over the barrel is one.
TEST(WorkShape, BedCarriesTheLoad)
{
  for (const double width : {0.05, 0.3, 1.0, 1.39, 1.4, 2.0}) {
    const FoundationShape shape = work_roll(width);
    double sum                  = 0;
    const int n                 = 4000;
    for (int i = 0; i < n; ++i)
      sum += 2 * deflection(shape, (i + 0.5) / n * 0.7) * 0.7 / n;
    EXPECT_TRUE(near(sum * 2.8708451127e10, 1, within(1e-6, "midpoint rule with 4000 points")));
  }
}

// A Timoshenko finite element computation gives 4.42089e-11 and 3.18653e-11: what the Euler assumption leaves out.
TEST(WorkShape, EulerAssumptionStaysWithinItsKnownBound)
{
  const Eigen::VectorXd timoshenko = reference_vector("work_shape.timoshenko_w0");
  EXPECT_TRUE(near(timoshenko[0] / deflection(work_roll(0.3), 0), 1.104,
                   within(1e-3, "stated as +10 % for a narrow strip")));
  EXPECT_TRUE(near(timoshenko[1] / deflection(work_roll(1.0), 0), 1.018,
                   within(1e-3, "stated as +1.8 % for a wide strip")));
}

TEST(WorkShape, RefusesABedWithoutStiffness)
{
  EXPECT_THROW(foundation_shape({0.7, 0.5, 0, 1e8}), InputError);
  EXPECT_THROW(foundation_shape({0.7, 0, 1e10, 1e8}), InputError);
}
