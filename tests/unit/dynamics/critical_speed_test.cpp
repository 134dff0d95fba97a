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
using mill::Linearisation;

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

TEST(CriticalSpeed, FindsTheRootOfAKnownFunction)
{
  const CriticalSpeed critical = crossings_of_roots(
      roots_of({{[](double v) { return std::log(v / 7.3); }, 120}, {[](double) { return -5; }, 80}}));
  ASSERT_EQ(critical.verdict, Verdict::crossing);
  EXPECT_TRUE(near(critical.speed, 7.3, within(2e-10 / 7.3, "the search ends at 1e-10 m/s, on either side")));
  EXPECT_TRUE(near(critical.frequency, 120, within(1e-12, "given")));
  ASSERT_EQ(critical.crossings.size(), 1u);
  EXPECT_TRUE(critical.crossings[0].upward && critical.crossings[0].of_stand);
  EXPECT_TRUE(near(critical.crossings[0].slope, 1 / 7.3,
                   within(1e-6, "taken where the root leaves the noise, 1e-9 of its modulus")));
  EXPECT_EQ(critical.lowest_bite, 1);
  EXPECT_EQ(critical.highest_bite, 30);
  EXPECT_EQ(sentence(critical, {}), "unstable above 7.300 m/s (120.0 Hz)");
}

// Unstable between 10.3 and 10.7 m/s only: both grid points, 10 and 11 m/s, are stable.
TEST(CriticalSpeed, AnIslandBetweenTwoGridPointsIsFound)
{
  const auto hill              = [](const double v) { return 0.04 - (v - 10.5) * (v - 10.5); };
  const CriticalSpeed critical = crossings_of_roots(roots_of({{hill, 100}, {[](double) { return -3; }, 60}}));
  ASSERT_EQ(critical.verdict, Verdict::crossing);
  EXPECT_TRUE(near(critical.speed, 10.3, within(2e-10 / 10.3, "the search ends at 1e-10 m/s, on either side")));
  ASSERT_EQ(critical.crossings.size(), 2u);
  EXPECT_TRUE(near(critical.crossings[1].speed, 10.7,
                   within(2e-10 / 10.7, "the search ends at 1e-10 m/s, on either side")));
  EXPECT_FALSE(critical.crossings[1].upward);
  EXPECT_EQ(sentence(critical, {}), "unstable above 10.300 m/s (100.0 Hz), stable above 10.700 m/s");
}

TEST(CriticalSpeed, DistinguishesTwoModes)
{
  const CriticalSpeed critical = crossings_of_roots(
      roots_of({{[](double v) { return 3 * (v - 15.2); }, 128}, {[](double v) { return 0.1 * (v - 15.1); }, 81}}));
  EXPECT_TRUE(near(critical.speed, 15.1,
                   within(2e-9 / 15.1, "1e-10 1/s of noise over a slope of 0.1 1/s per m/s, either side")));
  EXPECT_TRUE(near(critical.frequency, 81, within(1e-12, "given")));
  ASSERT_EQ(critical.crossings.size(), 2u);
  EXPECT_TRUE(near(critical.crossings[1].speed, 15.2,
                   within(2e-10 / 15.2, "the search ends at 1e-10 m/s, on either side")));
  EXPECT_FALSE(critical.crossings[1].of_stand);
  EXPECT_TRUE(near(critical.crossings[1].frequency, 128, within(1e-12, "given")));
}

TEST(CriticalSpeed, AStableRangeStatesItsMargin)
{
  const SpeedRange range{2, 20};
  const CriticalSpeed critical =
      crossings_of_roots(roots_of({{[](double v) { return -0.5 - 0.01 * std::pow(v - 13.37, 2); }, 100}}), range);
  EXPECT_EQ(critical.verdict, Verdict::stable);
  EXPECT_TRUE(std::isnan(critical.speed));
  EXPECT_TRUE(near(critical.margin, -0.5, within(1e-6 / 0.5, "flat top, golden sections to 0.01 m/s")));
  EXPECT_TRUE(near(critical.margin_speed, 13.37, within(0.01 / 13.37, "golden sections to 0.01 m/s")));
  EXPECT_EQ(sentence(critical, range), "stable from 2 to 20 m/s; the slowest decay is 0.5 1/s at 13.37 m/s");
}

TEST(CriticalSpeed, DistinguishesUnstableThroughoutFromUnstableBelow)
{
  const CriticalSpeed always = crossings_of_roots(roots_of({{[](double v) { return 1 + 0.1 * v; }, 100}}));
  EXPECT_EQ(always.verdict, Verdict::unstable);
  EXPECT_TRUE(near(always.margin, 1.1, within(1e-12, "end of the range")));
  EXPECT_EQ(sentence(always, {}), "unstable from 1 to 30 m/s; the slowest growth is 1.1 1/s at 1 m/s");
  const CriticalSpeed below = crossings_of_roots(roots_of({{[](double v) { return 6.5 - v; }, 100}}));
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
    return roots_of({{[](double x) { return x - 12.5; }, 100}})(v);
  };
  const CriticalSpeed critical = crossings_of_roots(roots);
  EXPECT_TRUE(near(critical.speed, 12.5, within(2e-10 / 12.5, "the search ends at 1e-10 m/s, on either side")));
  EXPECT_TRUE(near(critical.lowest_bite, 4.2, within(1e-3 / 4.2, "the edges are searched to 1e-3 m/s")));
  EXPECT_GE(critical.lowest_bite, 4.2);
  EXPECT_TRUE(near(critical.highest_bite, 21.4, within(1e-3 / 21.4, "the edges are searched to 1e-3 m/s")));
  EXPECT_EQ(critical.below, "no flattened radius: R'/R = 20");
  EXPECT_EQ(critical.above, "the rolls skid");
  EXPECT_EQ(sentence(critical, {}),
            "unstable above 12.500 m/s (100.0 Hz); no steady bite below 4.20 m/s; no steady bite above 21.40 m/s");
  for (const SpeedPoint &p : critical.points)
    EXPECT_EQ(p.no_bite.empty(), p.speed >= 4.2 && p.speed <= 21.4) << p.speed;
  const CriticalSpeed none = crossings_of_roots(roots, {22, 30});
  EXPECT_EQ(none.verdict, Verdict::no_bite);
  EXPECT_EQ(sentence(none, {22, 30}), "no steady bite from 22 to 30 m/s (the rolls skid)");
}

// Growth v - 12 with no answer between 11.25 and 12.625 m/s, which halving the grid meets: the crossing at 12 m/s
// lies in the gap.
TEST(CriticalSpeed, ACrossingInAGapOfSpeedsIsNamedByTheGap)
{
  const auto with_gap = [](const std::function<double(double)> &growth) {
    return [growth](const double v) -> Eigen::VectorXcd {
      if (v > 11.25 && v < 12.625)
        throw SolverError({"roots not found", "", "", "", ""});
      return roots_of({{growth, 100}})(v);
    };
  };
  const auto edge            = within(1e-3 / 12, "the edges are searched to 1e-3 m/s");
  const CriticalSpeed rising = crossings_of_roots(with_gap([](double v) { return v - 12; }));
  EXPECT_EQ(rising.verdict, Verdict::unstable_beyond_gap);
  EXPECT_TRUE(std::isnan(rising.speed));
  EXPECT_TRUE(near(rising.gap[0], 11.25, edge));
  EXPECT_TRUE(near(rising.gap[1], 12.625, edge));
  EXPECT_EQ(rising.gap_reason, "roots not found");
  EXPECT_EQ(sentence(rising, {}), "stable at 11.250 m/s and unstable from 12.625 m/s; the critical speed lies "
                                  "between them, where the search has no answer (roots not found)");

  // Stable again above 15 m/s and unstable above 20 m/s: the lowest change to growth is still that of the gap.
  const CriticalSpeed twice =
      crossings_of_roots(with_gap([](double v) { return (v - 12) * (v - 15) * (v - 20) / 100; }));
  EXPECT_EQ(twice.verdict, Verdict::unstable_beyond_gap);
  EXPECT_TRUE(near(twice.gap[0], 11.25, edge));

  // A crossing below the gap is the critical speed, whatever the gap hides.
  const CriticalSpeed before =
      crossings_of_roots(with_gap([](double v) { return (v - 5) * (v - 8) * (v - 12) / 100; }));
  EXPECT_EQ(before.verdict, Verdict::crossing);
  EXPECT_TRUE(near(before.speed, 5, within(2e-10 / 5, "the search ends at 1e-10 m/s, on either side")));

  // Falling growth crosses in the gap: unstable below only, up to its lower edge at least.
  const CriticalSpeed falling = crossings_of_roots(with_gap([](double v) { return 12 - v; }));
  EXPECT_EQ(falling.verdict, Verdict::unstable_below);
  EXPECT_EQ(sentence(falling, {}), "unstable up to 11.250 m/s and stable above, so that no speed is critical");
}

// Creeping away without vibration: one real root.
TEST(CriticalSpeed, FindsARealRootWithoutFrequency)
{
  const auto roots = [](const double v) -> Eigen::VectorXcd {
    Eigen::VectorXcd r(3);
    r << v - 9.1, std::complex<double>(-1, 50), std::complex<double>(-1, -50);
    return r;
  };
  const CriticalSpeed critical = crossings_of_roots(roots);
  EXPECT_TRUE(near(critical.speed, 9.1, within(2e-10 / 9.1, "the search ends at 1e-10 m/s, on either side")));
  EXPECT_EQ(critical.frequency, 0);
}

// Upper and lower half alike and no damper: three modes never move the gap and stand on the axis, where rounding
// puts them on either side.  They must not count.
TEST(CriticalSpeed, IgnoresUndampedModesOnTheAxis)
{
  const StandStructure alike =
      six_mass_structure({1e5, 7e4, 9e3, 9e3, 7e4, 1e5}, {7e10, 3e10, 6e10, 6e10, 3e10, 7e10}, {});
  const ChatterStandModel model{alike, 5, 5, 210e9};
  const StandSpeed critical = critical_speed(model, pass(), sequential_scheme);
  ASSERT_EQ(critical.verdict, Verdict::crossing);
  const auto matrix      = matrix_at_speed(model, pass(), sequential_scheme);
  const RouthCount below = routh_count(matrix(critical.speed - 1e-4)),
                   above = routh_count(matrix(critical.speed + 1e-4));
  EXPECT_EQ(below.unstable, 0);
  EXPECT_EQ(above.unstable, 2);
}

TEST(CriticalSpeed, AgreesWithRouthForAStandWithConstantFriction)
{
  const StandSpeed critical = critical_speed(four_high(), pass(), sequential_scheme);
  ASSERT_EQ(critical.verdict, Verdict::crossing);
  const auto matrix = matrix_at_speed(four_high(), pass(), sequential_scheme);
  EXPECT_TRUE(near(growth_rate(matrix(critical.speed)), 0,
                   within(1e-9, "tolerance of the speed times a slope of some 1/s per m/s", 1)));
  EXPECT_TRUE(near(boundary_by_routh(matrix, critical.speed - 0.01, critical.speed + 0.01), critical.speed,
                   within(1e-6 / critical.speed, "the boundary of Routh is halved to 1e-6 m/s")));
  EXPECT_LT(growth_rate(matrix(critical.speed - 0.1)), 0);
  EXPECT_GT(growth_rate(matrix(critical.speed + 0.1)), 0);
  ASSERT_TRUE(critical.at.has_value());
  EXPECT_EQ(critical.at->bite.roll_speed, critical.speed);
  ASSERT_EQ(critical.states.size(), critical.points.size());
  for (std::size_t i = 0; i < critical.points.size(); ++i)
    EXPECT_EQ(critical.states[i].force > 0, critical.points[i].no_bite.empty());
  // The same from the roots alone.
  const CriticalSpeed again = crossings_of_roots([&](const double v) { return eigenvalues(matrix(v)); });
  EXPECT_EQ(again.speed, critical.speed);
}

TEST(CriticalSpeed, RefusesARangeThatDoesNotRise)
{
  const auto search = [](const SpeedRange &range) {
    return refusal([&] { crossings_of_roots(roots_of({{[](double) { return -1; }, 10}}), range); });
  };
  EXPECT_EQ(search({20, 10}),
            "speeds from 20 to 10 m/s are not a range; both must be above zero and the second one larger");
  EXPECT_EQ(search({0, 10}),
            "speeds from 0 to 10 m/s are not a range; both must be above zero and the second one larger");
  EXPECT_EQ(search({1, 10, -1}), "steps of -1 and 0.03125 m/s and a tolerance of 1e-10 m/s have to be above zero");
}

// Three branches cross in growth and two in frequency; each keeps its own.
TEST(RootLocus, BranchesStayWithTheirModes)
{
  const std::vector<Pair> pairs{{[](double v) { return -5 + v / 2; }, 80},
                                {[](double v) { return -v / 3; }, 128},
                                {[](double v) { return -20 + 0.02 * v * v; }, 81}};
  const RootLocus locus = root_locus(matrix_of(pairs), Eigen::VectorXd::LinSpaced(30, 1, 30));
  ASSERT_EQ(locus.branch.rows(), 6);
  for (Eigen::Index row = 0; row < 6; ++row) {
    const double frequency = std::abs(locus.branch(row, 0).imag()) / (2 * pi);
    for (const Pair &p : pairs)
      if (std::abs(p.frequency - frequency) < 1e-6)
        for (Eigen::Index k = 0; k < 30; ++k) {
          EXPECT_LT(std::abs(locus.branch(row, k).real() - p.growth(locus.speed[k])), 1e-9)
              << "1/s, rounding of an eigenvalue; " << row << " " << k;
          EXPECT_TRUE(near(std::abs(locus.branch(row, k).imag()) / (2 * pi), p.frequency,
                           within(1e-9 / p.frequency, "rounding of an eigenvalue, 1e-9 Hz")))
              << row << " " << k;
        }
  }
}

TEST(RootLocus, CoversTheEigenvaluesAndLeavesOutSpeedsWithoutABite)
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

// Three methods for the number of the same roots, on passes and stands of another kind than the published one.
TEST(UnstableRoots, EigenvaluesRouthAndNyquistAgreeOnTheirNumber)
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

// On the axis itself the poles of an undamped structure have no side; next to it they have.
TEST(UnstableRoots, NyquistIsExactNextToTheAxisWithoutDampers)
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
