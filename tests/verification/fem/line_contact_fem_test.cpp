#include "tests/manual/solvers/full_contact.h"
#include "tests/support/closed_form.h"
#include "tests/support/near.h"
#include "tests/support/roll_pair.h"

// Two long rolls as plane-strain slabs, each squeezed between two opposite contacts: the state of Johnson's closed
// form.
using namespace mill;

namespace {
struct Pair {
  double D1, D2, E, nu;
};

struct Slabs {
  MeshedBody upper, lower;
  fem::ContactPair contact;
};

Slabs slabs(const Pair &p, const double low, const double high, const int per_half_width, const int degree = 2)
{
  const double thickness = p.D1 / 20;
  const auto b = [&](const double q) { return closed_form::line_contact(q, p.D1, p.D2, p.E, p.nu).half_width; };
  const Material steel{p.E, p.nu, 7700};
  Slabs s{meshed_slab("upper", p.D1, b(low), b(high), per_half_width, thickness, steel, degree),
          meshed_slab("lower", p.D2, b(low), b(high), per_half_width, thickness, steel, degree),
          {}};
  s.contact = slab_pair(s.upper, s.lower);
  return s;
}

const Pair rolls{0.400, 1.300, 210e9, 0.3};
}  // namespace

TEST(LineContactFem, MeetsTheClosedFormOverTheSweep)
{
  // Rolls, a small roller on a large one, and equal cylinders of soft material: the method must not know the
  // table.
  const std::vector<Pair> pairs{rolls, {0.050, 0.900, 206e9, 0.3}, {0.6, 0.6, 70e9, 0.33}};
  for (const Pair &p : pairs) {
    const double low = 200e3 * p.E / 210e9, high = 5000e3 * p.E / 210e9;
    const auto s     = slabs(p, low, high, 8);
    const auto curve = fem::sweep(s.contact, fem::log_spaced(low, high, 20));
    for (int i = 0; i < 20; ++i) {
      const auto exact = closed_form::line_contact(curve.load[i], p.D1, p.D2, p.E, p.nu);
      EXPECT_TRUE(
          near(curve.half_width[i], exact.half_width, within(0.01, "fitted through 8 elements per half width")));
      EXPECT_TRUE(near(curve.peak_pressure[i], exact.peak_pressure, within(0.01, "fitted through 8 elements")));
      EXPECT_TRUE(
          near(curve.approach[i], exact.approach, within(0.003, "energy converges with the square of h/b")));
      EXPECT_TRUE(near(
          curve.tangent[i], exact.tangent,
          within(0.01, "edge known to one node of 16: d ln b^2 = 2/16 of ln(16 R1 R2/b^2) - 2, half either way")));
      EXPECT_LE(curve.iterations[i], i ? 8 : 12);
    }
    EXPECT_LE(curve.residual, 1e-12);
  }
}

TEST(LineContactFem, ApproachConverges)
{
  const auto exact = closed_form::line_contact(1000e3, rolls.D1, rolls.D2, rolls.E, rolls.nu);
  double previous  = 1;
  for (const int n : {2, 4, 8}) {
    const auto s       = slabs(rolls, 1000e3, 1000e3, n);
    const double error = std::abs(fem::solve_load(s.contact, 1000e3).approach / exact.approach - 1);
    EXPECT_LT(error, 0.7 * previous) << n << " elements per half width";
    previous = error;
  }
  EXPECT_LT(previous, 5e-4)
      << "half-space closed form itself is good to (b/R)^2 = 4e-5, mesh away from the contact to 3e-4";
}

TEST(LineContactFem, TrilinearElementsConvergeToTheSameAnswer)
{
  const auto exact = closed_form::line_contact(1000e3, rolls.D1, rolls.D2, rolls.E, rolls.nu);
  double previous  = 1;
  for (const int n : {3, 6, 12}) {
    const auto s       = slabs(rolls, 1000e3, 1000e3, n, 1);
    const double error = std::abs(fem::solve_load(s.contact, 1000e3).approach / exact.approach - 1);
    EXPECT_LT(error, previous) << n << " elements per half width";
    previous = error;
  }
  // The far grid is the same in all three: that of quadratic elements, coarse for linear ones.
  EXPECT_LT(previous, 0.05) << "twelve linear elements per half width";
}

TEST(LineContactFem, TangentIsTheSlopeOfItsOwnCurve)
{
  const auto s = slabs(rolls, 200e3, 5000e3, 4);
  for (const double q : {250e3, 1000e3, 4000e3}) {
    const auto result  = fem::solve_load(s.contact, q);
    const double step  = 1e-6 * q;
    const double above = fem::solve_load(s.contact, q + step, result.state.active).approach;
    const double below = fem::solve_load(s.contact, q - step, result.state.active).approach;
    EXPECT_TRUE(near(result.tangent, 2 * step / (above - below), within(1e-6, "linear inside one active set")));
  }
}

TEST(LineContactFem, CondensedEqualsFullModelOnTheSameMesh)
{
  const auto s      = slabs(rolls, 1000e3, 1000e3, 3);
  const auto result = fem::solve_load(s.contact, 1000e3);
  const auto all =
      fem::solve_full_contact(*s.upper.body, *s.lower.body, s.contact.problem.initial_gap, result.approach, true);
  EXPECT_TRUE(near(all.force, result.state.nodal.sum(),
                   within(1e-8, "same equations by two ways, conditioning 1e7 x rounding")));
  for (Eigen::Index i = 0; i < all.nodal.size(); ++i)
    EXPECT_TRUE(near(all.nodal[i], result.state.nodal[i], within(1e-8, "same equations", all.nodal.maxCoeff())));
}

TEST(LineContactFem, DoesNotDependOnTheSizeOfThings)
{
  // Ten times the geometry at ten times the line load is the same problem; so is another modulus at scaled load.
  const auto small = slabs(rolls, 1000e3, 1000e3, 3);
  const auto large = slabs({4.00, 13.00, 210e9, 0.3}, 10000e3, 10000e3, 3);
  const auto a = fem::solve_load(small.contact, 1000e3), b = fem::solve_load(large.contact, 10000e3);
  EXPECT_EQ(a.state.active, b.state.active);
  EXPECT_TRUE(near(b.approach, 10 * a.approach, within(1e-9, "scaling; mesh coordinates written with 16 digits")));
  EXPECT_TRUE(near(b.tangent, a.tangent, within(1e-9, "scaling; mesh coordinates written with 16 digits")));
}
