// The search for the critical speed on systems whose answer is known, and on stands with a bite.
#include "core/base/errors.h"
#include "dynamics/chatter/loop.h"
#include "dynamics/chatter/modes.h"
#include "dynamics/chatter/routh.h"
#include "dynamics/chatter/speed.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>
#include <utility>

using namespace mill;
using namespace mill::dynamics;
using bite::Linearisation;

namespace {
constexpr double pi = 3.14159265358979323846;

// Pairs of roots a +- i w from functions of the speed.
struct Pair {
  std::function<double(double)> growth;  ///< 1/s
  double frequency;                      ///< Hz
};

RootsAtSpeed roots_of(std::vector<Pair> pairs)
{
  return [pairs = std::move(pairs)](const double v) {
    Eigen::VectorXcd roots(2 * Eigen::Index(pairs.size()));
    Eigen::Index i = 0;
    for (const Pair &p : pairs)
      for (const double sign : {1., -1.})
        roots[i++] = {p.growth(v), sign * 2 * pi * p.frequency};
    return roots;
  };
}

MatrixAtSpeed matrix_of(std::vector<Pair> pairs)
{
  return [pairs = std::move(pairs)](const double v) {
    const auto n      = 2 * Eigen::Index(pairs.size());
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; i += 2) {
      const Pair &p  = pairs[std::size_t(i / 2)];
      const double w = 2 * pi * p.frequency;
      A.block(i, i, 2, 2) << p.growth(v), w, -w, p.growth(v);
    }
    return A;
  };
}

ChatterStandModel four_high(const double damping = 1)
{
  const std::array<double, 6> m{119e3, 75e3, 9.2e3, 9.2e3, 75e3, 36.5e3},
      k{6.9e10, 3.0e10, 6.06e10, 6.06e10, 4.4e10, 10.1e10};
  std::array<double, 6> c{6.05e5, 4.25e5, 6.05e5, 6.05e5, 4.25e5, 6.05e5};
  for (double &x : c)
    x *= damping;
  return {six_mass_structure(m, k, c), 4.95, 4.95, 210e9};
}

bite::RollBite pass()
{
  bite::RollBite b;
  b.roll_radius                = 0.28;
  b.roll                       = {2.1e11, 0.3, 7850};
  b.strip.width                = 1;
  b.strip.entry_thickness      = 0.9e-3;
  b.strip.exit_thickness       = 0.63e-3;
  b.strip.entry_tension        = 150e6;
  b.strip.exit_tension         = 190e6;
  b.strip.flow_stress.k        = 720e6;
  b.strip.friction.coefficient = 0.03;
  return b;
}

constexpr auto sequential_scheme = Linearisation::sequential;
}  // namespace

TEST(CriticalSpeed, RootOfAKnownFunction)
{
  const CriticalSpeed found = crossings_of_roots(roots_of({
      {[](double v) { return std::log(v / 7.3); }, 120},
      {[](double) { return -5; },                  80 }
  }));
  ASSERT_EQ(found.verdict, Verdict::crossing);
  EXPECT_NEAR(found.speed, 7.3, 2e-10);  // tolerance of the search
  EXPECT_TRUE(near(found.frequency, 120, within(1e-12, "given")));
  ASSERT_EQ(found.crossings.size(), 1u);
  EXPECT_TRUE(found.crossings[0].upward && found.crossings[0].of_stand);
  EXPECT_TRUE(near(found.crossings[0].slope, 1 / 7.3,
                   within(1e-6, "taken where the root leaves the noise, 1e-9 of its modulus")));
  EXPECT_EQ(found.lowest_bite, 1);
  EXPECT_EQ(found.highest_bite, 30);
  EXPECT_EQ(sentence(found, {}), "unstable above 7.300 m/s (120.0 Hz)");
}

// Unstable between 10.3 and 10.7 m/s only: both grid points, 10 and 11 m/s, are stable.
TEST(CriticalSpeed, AnIslandBetweenTwoGridPointsIsFound)
{
  const auto hill           = [](const double v) { return 0.04 - (v - 10.5) * (v - 10.5); };
  const CriticalSpeed found = crossings_of_roots(roots_of({
      {hill,                      100},
      {[](double) { return -3; }, 60 }
  }));
  ASSERT_EQ(found.verdict, Verdict::crossing);
  EXPECT_NEAR(found.speed, 10.3, 2e-10);
  ASSERT_EQ(found.crossings.size(), 2u);
  EXPECT_NEAR(found.crossings[1].speed, 10.7, 2e-10);
  EXPECT_FALSE(found.crossings[1].upward);
  EXPECT_EQ(sentence(found, {}), "unstable above 10.300 m/s (100.0 Hz), stable above 10.700 m/s");
}

TEST(CriticalSpeed, TwoModesAreKeptApart)
{
  const CriticalSpeed found = crossings_of_roots(roots_of({
      {[](double v) { return 3 * (v - 15.2); },   128},
      {[](double v) { return 0.1 * (v - 15.1); }, 81 }
  }));
  EXPECT_NEAR(found.speed, 15.1, 2e-9);  // 1e-10 1/s of noise over a slope of 0.1
  EXPECT_TRUE(near(found.frequency, 81, within(1e-12, "given")));
  ASSERT_EQ(found.crossings.size(), 2u);
  EXPECT_NEAR(found.crossings[1].speed, 15.2, 2e-10);
  EXPECT_FALSE(found.crossings[1].of_stand);
  EXPECT_TRUE(near(found.crossings[1].frequency, 128, within(1e-12, "given")));
}

TEST(CriticalSpeed, StableThroughoutSaysHowNear)
{
  const SpeedRange range{2, 20};
  const CriticalSpeed found =
      crossings_of_roots(roots_of({
                             {[](double v) { return -0.5 - 0.01 * std::pow(v - 13.37, 2); }, 100}
  }),
                         range);
  EXPECT_EQ(found.verdict, Verdict::stable);
  EXPECT_TRUE(std::isnan(found.speed));
  EXPECT_NEAR(found.margin, -0.5, 1e-6);         // flat top, golden sections to 0.01 m/s
  EXPECT_NEAR(found.margin_speed, 13.37, 0.01);  // the same
  EXPECT_EQ(sentence(found, range), "stable from 2 to 20 m/s; the slowest decay is 0.5 1/s at 13.37 m/s");
}

TEST(CriticalSpeed, UnstableThroughoutAndUnstableBelow)
{
  const CriticalSpeed always = crossings_of_roots(roots_of({
      {[](double v) { return 1 + 0.1 * v; }, 100}
  }));
  EXPECT_EQ(always.verdict, Verdict::unstable);
  EXPECT_TRUE(near(always.margin, 1.1, within(1e-12, "end of the range")));
  EXPECT_EQ(sentence(always, {}), "unstable from 1 to 30 m/s; the slowest growth is 1.1 1/s at 1 m/s");
  const CriticalSpeed below = crossings_of_roots(roots_of({
      {[](double v) { return 6.5 - v; }, 100}
  }));
  EXPECT_EQ(below.verdict, Verdict::unstable_below);
  EXPECT_TRUE(std::isnan(below.speed));
  EXPECT_EQ(sentence(below, {}), "unstable up to 6.500 m/s and stable above, so that no speed is critical");
}

TEST(CriticalSpeed, EdgesOfTheBiteAreFoundWithTheirReason)
{
  const auto roots = [](const double v) -> Eigen::VectorXcd {
    if (v < 4.2)
      throw SolverError({"no flattened radius", "R'/R = 20", "", "", ""});
    if (v > 21.4)
      throw InputError("the rolls skid");
    return roots_of({
        {[](double x) { return x - 12.5; }, 100}
    })(v);
  };
  const CriticalSpeed found = crossings_of_roots(roots);
  EXPECT_NEAR(found.speed, 12.5, 2e-10);
  EXPECT_NEAR(found.lowest_bite, 4.2, 1e-3);  // as fine as the edges are searched
  EXPECT_GE(found.lowest_bite, 4.2);
  EXPECT_NEAR(found.highest_bite, 21.4, 1e-3);
  EXPECT_EQ(found.below, "no flattened radius: R'/R = 20");
  EXPECT_EQ(found.above, "the rolls skid");
  EXPECT_EQ(sentence(found, {}),
            "unstable above 12.500 m/s (100.0 Hz); no steady bite below 4.20 m/s; no steady bite above 21.40 m/s");
  for (const SpeedPoint &p : found.points)
    EXPECT_EQ(p.no_bite.empty(), p.speed >= 4.2 && p.speed <= 21.4) << p.speed;
  const CriticalSpeed none = crossings_of_roots(roots, {22, 30});
  EXPECT_EQ(none.verdict, Verdict::no_bite);
  EXPECT_EQ(sentence(none, {22, 30}), "no steady bite from 22 to 30 m/s (the rolls skid)");
}

// Creeping away without vibration: one real root.
TEST(CriticalSpeed, ARealRootCounts)
{
  const auto roots = [](const double v) -> Eigen::VectorXcd {
    Eigen::VectorXcd r(3);
    r << v - 9.1, std::complex<double>(-1, 50), std::complex<double>(-1, -50);
    return r;
  };
  const CriticalSpeed found = crossings_of_roots(roots);
  EXPECT_NEAR(found.speed, 9.1, 2e-10);
  EXPECT_EQ(found.frequency, 0);
}

// Upper and lower half alike and no damper: three modes never move the gap and stand on the axis, where rounding
// puts them on either side.  They must not count.
TEST(CriticalSpeed, UndampedModesOnTheAxisDoNotCount)
{
  const StandStructure alike =
      six_mass_structure({1e5, 7e4, 9e3, 9e3, 7e4, 1e5}, {7e10, 3e10, 6e10, 6e10, 3e10, 7e10}, {});
  const ChatterStandModel model{alike, 5, 5, 210e9};
  const StandSpeed found = critical_speed(model, pass(), sequential_scheme);
  ASSERT_EQ(found.verdict, Verdict::crossing);
  const auto matrix      = matrix_at_speed(model, pass(), sequential_scheme);
  const RouthCount below = routh_count(matrix(found.speed - 1e-4)),
                   above = routh_count(matrix(found.speed + 1e-4));
  EXPECT_EQ(below.unstable, 0);
  EXPECT_EQ(above.unstable, 2);
}

TEST(CriticalSpeed, OfAStandWithConstantFriction)
{
  const StandSpeed found = critical_speed(four_high(), pass(), sequential_scheme);
  ASSERT_EQ(found.verdict, Verdict::crossing);
  const auto matrix = matrix_at_speed(four_high(), pass(), sequential_scheme);
  EXPECT_NEAR(growth_rate(matrix(found.speed)), 0, 1e-9);  // 1/s, tolerance of the speed times the slope
  EXPECT_NEAR(boundary_by_routh(matrix, found.speed - 0.01, found.speed + 0.01), found.speed,
              1e-6);  // its halving
  EXPECT_LT(growth_rate(matrix(found.speed - 0.1)), 0);
  EXPECT_GT(growth_rate(matrix(found.speed + 0.1)), 0);
  ASSERT_TRUE(found.at.has_value());
  EXPECT_EQ(found.at->bite.roll_speed, found.speed);
  ASSERT_EQ(found.states.size(), found.points.size());
  for (std::size_t i = 0; i < found.points.size(); ++i)
    EXPECT_EQ(found.states[i].force > 0, found.points[i].no_bite.empty());
  // The same from the roots alone.
  const CriticalSpeed again = crossings_of_roots([&](const double v) { return eigenvalues(matrix(v)); });
  EXPECT_EQ(again.speed, found.speed);
}

TEST(CriticalSpeed, RefusesARangeThatIsNone)
{
  const auto search = [](const SpeedRange &range) {
    return refusal([&] {
      crossings_of_roots(roots_of({
                             {[](double) { return -1; }, 10}
      }),
                         range);
    });
  };
  EXPECT_EQ(search({20, 10}), "speeds from 20 to 10 m/s are no range; both ends above zero and rising are needed");
  EXPECT_EQ(search({0, 10}), "speeds from 0 to 10 m/s are no range; both ends above zero and rising are needed");
  EXPECT_EQ(search({1, 10, -1}), "steps of -1 and 0.03125 m/s and a tolerance of 1e-10 m/s have to be above zero");
}

// Three branches cross in growth and two in frequency; each keeps its own.
TEST(RootLocus, BranchesStayWithTheirModes)
{
  const std::vector<Pair> pairs{
      {[](double v) { return -5 + v / 2; },         80 },
      {[](double v) { return -v / 3; },             128},
      {[](double v) { return -20 + 0.02 * v * v; }, 81 }
  };
  const RootLocus locus = root_locus(matrix_of(pairs), Eigen::VectorXd::LinSpaced(30, 1, 30));
  ASSERT_EQ(locus.branch.rows(), 6);
  for (Eigen::Index row = 0; row < 6; ++row) {
    const double frequency = std::abs(locus.branch(row, 0).imag()) / (2 * pi);
    for (const Pair &p : pairs)
      if (std::abs(p.frequency - frequency) < 1e-6)
        for (Eigen::Index k = 0; k < 30; ++k) {
          EXPECT_NEAR(locus.branch(row, k).real(), p.growth(locus.speed[k]), 1e-9) << row << " " << k;
          EXPECT_NEAR(std::abs(locus.branch(row, k).imag()) / (2 * pi), p.frequency, 1e-9) << row << " " << k;
        }
  }
}

TEST(RootLocus, CoversTheEigenvaluesAndLeavesOutWhatHasNoBite)
{
  const auto matrix     = matrix_at_speed(four_high(), pass(), sequential_scheme);
  const auto from_three = [&](const double v) -> Eigen::MatrixXd {
    if (v < 3)
      throw InputError("no bite");
    return matrix(v);
  };
  const RootLocus locus = root_locus(from_three, Eigen::VectorXd::LinSpaced(15, 2, 30));
  ASSERT_EQ(locus.branch.rows(), 14);
  EXPECT_TRUE(std::isnan(locus.branch(0, 0).real()));
  for (Eigen::Index k = 1; k < 15; ++k) {
    const Eigen::VectorXcd roots = eigenvalues(matrix(locus.speed[k]));
    EXPECT_TRUE(near(locus.branch.col(k).sum().real(), roots.sum().real(), within(1e-12, "the same roots")));
    EXPECT_EQ(locus.branch.col(k).real().maxCoeff(), roots.real().maxCoeff());
  }
}

// Three counts of the same roots, on passes and stands of another kind than the published one.
TEST(Counts, EigenvaluesRouthAndNyquistAgree)
{
  for (const double damping : {0.1, 1., 30.})
    for (const double speed : {6., 12., 18., 24., 30.}) {
      const auto by           = working_point(pass(), speed, sequential_scheme).by;
      const Eigen::MatrixXd A = chatter_matrix(four_high(damping), by);
      const int roots         = int((eigenvalues(A).real().array() > 0).count());
      EXPECT_EQ(unstable_roots(A), roots) << damping << " " << speed;
      EXPECT_EQ(nyquist_count(four_high(damping), by).unstable, roots) << damping << " " << speed;
    }
}

// On the axis itself the poles of an undamped structure have no side; beside it they have.
TEST(Counts, NyquistBesideTheAxisWithoutDampers)
{
  const ChatterStandModel bare = four_high(0);
  for (const double speed : {8., 16., 24.}) {
    const auto by           = working_point(pass(), speed, sequential_scheme).by;
    const Eigen::MatrixXd A = chatter_matrix(bare, by);
    const int roots         = int((eigenvalues(A).real().array() > 0.01).count());
    EXPECT_EQ(nyquist_count(bare, by, 0.01).unstable, roots) << speed;
    EXPECT_EQ(routh_count(A, 0.01).unstable, roots) << speed;
  }
}
