// Force over compression of a contact from its samples: what they say, and what is between and beyond them.
#include "dynamics/nonlinear/spring_law.h"
#include "tests/support/curve_stands.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill::dynamics;

TEST(SpringLaw, ReproducesItsSamplesAndAPowerLawBetweenAndBeyondThem)
{
  const SpringLaw law = power_law(1e13, 1.5, 1e5, 3e6, 9);
  ASSERT_TRUE(law.usable());
  for (const double load : {1e3, 9e4, 1e5, 2.3e5, 1e6, 3e6, 5e6}) {
    const double d      = std::pow(load / 1e13, 2 / 3.);
    const SpringForce f = law.at(d);
    EXPECT_TRUE(near(f.force, load, within(1e-10, "cubics on a thousand cells")));
    EXPECT_TRUE(near(f.stiffness, 1.5 * load / d, within(1e-8, "their slopes")));
    EXPECT_TRUE(near(law.energy(d), 0.4 * load * d, within(1e-10, "exact integral of the cubics")));
    EXPECT_TRUE(near(law.compression(load), d, within(1e-10, "inverse")));
  }
}

TEST(SpringLaw, HasNoForceBelowZeroAndStartsWithoutAStep)
{
  const SpringLaw law = power_law(1e13, 1.5, 1e5, 3e6, 9);
  for (const double d : {-1.0, -1e-9, 0.0}) {
    EXPECT_EQ(law.at(d).force, 0);
    EXPECT_EQ(law.at(d).stiffness, 0);
    EXPECT_EQ(law.energy(d), 0);
  }
  EXPECT_LT(law.at(1e-12).stiffness, 1e-3 * law.at(1e-5).stiffness);
}

TEST(SpringLaw, EnergyIsTheIntegralOfTheForceWhateverTheSamples)
{
  const SpringLaw law({1e5, 2e5, 7e5, 1e6}, {4e-6, 7e-6, 20e-6, 27e-6});
  for (const auto &[from, to] : {std::pair(1e-6, 3e-6), std::pair(2e-6, 25e-6), std::pair(20e-6, 40e-6)}) {
    double sum     = 0;
    const int n    = 200000;
    const double h = (to - from) / n;
    for (int i = 0; i < n; ++i)
      sum += h * law.at(from + (i + 0.5) * h).force;
    EXPECT_TRUE(near(law.energy(to) - law.energy(from), sum, within(1e-9, "midpoint rule of 2e5 parts")));
  }
}

TEST(SpringLaw, InSeriesTheCompliancesAdd)
{
  const SpringLaw law = power_law(1e13, 1.5, 1e5, 3e6, 9), both = law.in_series_with(3e-11);
  for (const double load : {1e5, 5e5, 2e6}) {
    const double d = law.compression(load);
    EXPECT_TRUE(near(both.compression(load), d + 3e-11 * load, within(1e-10, "table")));
    EXPECT_TRUE(near(1 / both.at(both.compression(load)).stiffness, 1 / law.at(d).stiffness + 3e-11,
                     within(1e-8, "slopes of the cubics")));
  }
  EXPECT_FALSE(law.in_series_with(-1e-9).usable());
}

TEST(SpringLaw, KeepsRisingThroughUnevenSamples)
{
  const SpringLaw law({1e5, 1.1e5, 9e5, 1e6}, {1e-6, 9e-6, 9.5e-6, 40e-6});
  ASSERT_TRUE(law.usable());
  for (int i = 1; i < 5000; ++i)
    EXPECT_GT(law.at(i * 1e-8).force, law.at((i - 1) * 1e-8).force) << i;
}

TEST(SpringLaw, RefusesSamplesThatDoNotRise)
{
  EXPECT_FALSE(SpringLaw({1e5}, {1e-6}).usable());
  EXPECT_FALSE(SpringLaw({1e5, 2e5}, {2e-6, 1e-6}).usable());
  EXPECT_FALSE(SpringLaw({0, 2e5}, {1e-6, 2e-6}).usable());
  EXPECT_FALSE(SpringLaw({1e5, 2e5}, {1e-6, std::nan("")}).usable());
}
