#include "fem/roll/frictional_pair.h"
#include "tests/support/near.h"
#include "tests/support/roll_pair.h"

using namespace mill;

namespace {
const Material steel{210e9, 0.3, 7850};

// Two discs in plane strain with their tangential components, 1000 N/mm.
struct Discs {
  fem::CondensedRoll upper, lower;
  fem::ContactPair pair;
};

Discs discs(const double upper, const double lower)
{
  const auto condensed = [](const MeshedBody &m) {
    fem::CondenseOptions options;
    options.slab = options.tractions = true;
    return fem::condense(*m.body, m.mesh.geometry, options);
  };
  const double b = 1.3e-3;
  Discs d{condensed(meshed_slab("upper", upper, b, b, 4, 0.02, steel)),
          condensed(meshed_slab("lower", lower, b, b, 4, 0.02, steel)),
          {}};
  d.pair = fem::make_pair("line", d.upper, fem::held_by_mirror(d.upper), d.lower, fem::held_by_mirror(d.lower),
                          Eigen::VectorXd::Zero(d.upper.grid.n_z));
  return d;
}

constexpr double load = 1e6;  // N/m
}  // namespace

// Equal discs move alike along the contact: the plane of contact is one of symmetry and nothing slides.
TEST(FrictionEffect, IsZeroForEqualDiscs)
{
  const Discs d     = discs(0.5, 0.5);
  const auto effect = fem::friction_effect(d.pair, d.upper, d.lower, 0.3, load, 4);
  EXPECT_TRUE(near(effect.ratio, 1, within(1e-9, "symmetry; rounding of two solvers")));
  EXPECT_EQ(effect.slipping, 0);
}

TEST(FrictionEffect, VanishesWithFriction)
{
  const Discs d     = discs(0.4, 1.3);
  const double none = fem::friction_effect(d.pair, d.upper, d.lower, 0, load, 4).ratio,
               some = fem::friction_effect(d.pair, d.upper, d.lower, 0.3, load, 4).ratio;
  EXPECT_TRUE(near(none, 1, within(1e-9, "the same problem, two solvers")));
  // Tangential forces oppose the motion: stiffer, by a few parts in a thousand where b/R is 1/100.
  EXPECT_GT(some, 1);
  EXPECT_LT(some, 1.02);
}
