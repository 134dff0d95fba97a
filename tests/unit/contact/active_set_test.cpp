#include "core/base/errors.h"
#include "fem/contact/active_set.h"
#include "fem/contact/hertz.h"
#include "tests/support/contact_problems.h"
#include "tests/support/near.h"
#include <Eigen/Cholesky>
#include <limits>
#include <utility>

using namespace mill::contact;
using namespace contact_problems;

namespace {
// The four conditions, evaluated from the answer alone; relative to the closing and to the largest force.
double violation(const Problem &p, const State &s, const Loading &loading)
{
  Eigen::VectorXd gap = p.initial_gap + p.C * s.nodal - p.G * s.motion;
  if (p.W.size())
    gap += p.W * s.resultant;
  const double length = std::max((p.G * s.motion).cwiseAbs().maxCoeff(), 1e-300);
  const double force  = std::max(s.nodal.maxCoeff(), 1e-300);
  double worst        = std::max({-gap.minCoeff() / length, -s.nodal.minCoeff() / force,
                                  gap.cwiseProduct(s.nodal).cwiseAbs().maxCoeff() / (length * force)});
  for (Eigen::Index j = 0; j < p.G.cols(); ++j) {
    const double made_of  = p.G.col(j).cwiseAbs().dot(s.nodal) + 1e-300;
    const bool prescribed = !loading.prescribed.empty() && loading.prescribed[j];
    worst                 = std::max(worst, std::abs(p.G.col(j).dot(s.nodal) - s.resultant[j]) / made_of);
    worst = std::max(worst, std::abs((prescribed ? s.motion[j] : s.resultant[j]) - loading.value[j]) /
                                (prescribed ? std::max(1e-300, std::abs(loading.value[j])) : made_of));
  }
  return worst;
}

Loading force_and_moments(const Problem &p, const double force, const double share)
{
  Loading d{Eigen::VectorXd::Zero(p.G.cols()), {}};
  d.value[0] = force;
  for (Eigen::Index j = 1; j < p.G.cols(); ++j)
    d.value[j] = share * force * p.G.col(j).maxCoeff();
  return d;
}
}  // namespace

TEST(ActiveSet, SatisfiesTheConditionsForAnyMixOfModes)
{
  for (unsigned seed = 1; seed <= 120; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1, 1);
    const int k = 1 + int(seed % 3);
    auto p      = rough(10 + int(random() % 150), k, seed);
    if (seed % 4 == 0)  // what balances deflects along the same modes
      p.W = 0.2 * p.G;
    Loading d = force_and_moments(p, 0.5 + 5 * std::abs(u(random)), 0.3 * u(random));
    d.prescribed.assign(k, 0);
    for (int j = 0; j < k; ++j)
      if (random() % 2) {
        d.prescribed[j] = 1;
        d.value[j]      = j == 0 ? 0.5 + std::abs(u(random)) : 0.3 * u(random);
      }
    ActiveSet solver(p);
    const State s = solver.solve(d);
    EXPECT_LE(violation(p, s, d), 1e-12) << "seed " << seed;  // rounding of sums of 160 terms
    EXPECT_LE(s.residual, 1e-12) << "seed " << seed;
    EXPECT_LE(s.iterations, 8) << "seed " << seed;
  }
}

TEST(ActiveSet, AnswerDoesNotDependOnTheStart)
{
  const auto p = rough(120, 2, 5);
  const auto d = force_and_moments(p, 2., 0.2);
  ActiveSet solver(p);
  const State cold = solver.solve(d);
  std::mt19937 random(11);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<char> start(120);
    for (char &a : start)
      a = random() % 2;
    const State warm = solver.solve(d, start);
    EXPECT_EQ(warm.active, cold.active) << "trial " << trial;
    EXPECT_TRUE(near(warm.motion, cold.motion, within(1e-12, "same equations in another order")));
  }
  EXPECT_EQ(solver.solve(d, std::vector<char>(120, 0)).active, cold.active);
  EXPECT_EQ(solver.solve(d, cold.active).iterations, 1);
  EXPECT_EQ(solver.solve(d).iterations, 1);
}

TEST(ActiveSet, FewIterationsColdAndWarmOnHertzContacts)
{
  const auto count = [](Problem p, const std::vector<Loading> &sweep, const char *name) {
    ActiveSet solver(std::move(p));
    int warmest = 0;
    for (const bool up : {true, false}) {
      solver.forget();
      for (std::size_t i = 0; i < sweep.size(); ++i) {
        const State s = solver.solve(up ? sweep[i] : sweep[sweep.size() - 1 - i]);
        EXPECT_LE(s.residual, 1e-12) << name;
        if (i == 0)
          EXPECT_LE(s.iterations, 8) << name;
        else
          warmest = std::max(warmest, s.iterations);
      }
    }
    EXPECT_LE(warmest, 3) << name;
  };
  std::vector<Loading> even, geometric, tilted;
  for (int i = 1; i <= 20; ++i) {
    even.push_back({one(50. * i), {}});
    geometric.push_back({one(1000 * std::pow(25., (i - 20) / 19.)), {}});
    tilted.push_back({Eigen::Vector2d(30e3 * i, 30e3 * i * 0.05), {}});
  }
  count(sphere(30, 0.45e-3), even, "sphere, even loads");
  count(sphere(30, 0.45e-3), geometric, "sphere, loads in proportion");
  count(roll_pair(15, 50, 1.8e-3), tilted, "crowned rolls, load off the middle");
}

TEST(ActiveSet, SphereAgainstHertz)
{
  ActiveSet solver(sphere(40, 0.46e-3));
  const State s    = solver.solve({one(1000.), {}});
  const auto exact = hertz_point(1000, 0.010, 0.010, contact_modulus(half_spaces(steel, steel)));
  // 35 squares across the contact; uniform pressure per square: the error is of second order, (1/35)^2.
  EXPECT_TRUE(near(s.motion[0], exact.approach, within(1e-3, "35 elements across, (1/35)^2")));
  EXPECT_TRUE(near(s.stiffness(0, 0), exact.tangent, within(1.5e-2, "a steps by half an element of 35")));
  EXPECT_TRUE(near(s.stiffness(0, 0) * s.compliance(0, 0), 1., within(1e-12, "inverse")));
}

TEST(ActiveSet, TangentIsTheDerivative)
{
  for (unsigned seed = 1; seed <= 5; ++seed) {
    auto p = rough(80, 3, seed);
    p.W    = 0.1 * p.G;
    ActiveSet solver(p);
    const auto d  = force_and_moments(p, 3., 0.1);
    const State s = solver.solve(d);
    for (int j = 0; j < 3; ++j) {
      Loading more = d, less = d;
      const double step = 1e-6;
      more.value[j] += step;
      less.value[j] -= step;
      const State high = solver.solve(more, s.active), low = solver.solve(less, s.active);
      ASSERT_EQ(high.active, low.active) << "seed " << seed;  // the derivative exists
      EXPECT_TRUE(
          near(s.compliance.col(j), (high.motion - low.motion) / (2 * step),
               within(1e-8, "linear inside one set; rounding / step", s.compliance.cwiseAbs().maxCoeff())));
      EXPECT_TRUE(near(s.d_nodal.col(j), (high.nodal - low.nodal) / (2 * step),
                       within(1e-8, "linear inside one set; rounding / step", s.d_nodal.cwiseAbs().maxCoeff())));
    }
  }
}

TEST(ActiveSet, UnitsDoNotMatter)
{
  // Lengths in millimetres, stiffness a million times higher, tilt in milliradians.
  const auto p = rough(100, 3, 8);
  const auto d = force_and_moments(p, 2., 0.2);
  Problem q    = p;
  q.C *= 1e3 / 1e6;
  q.initial_gap *= 1e3;
  q.G.rightCols(2) *= 1e3 * 1e-3;
  q.G.col(2) *= 1e5;  // and a tilt whose unit is absurd
  Loading e = d;
  e.value *= 1e6;
  e.value[2] *= 1e5;
  const State a = ActiveSet(p).solve(d), b = ActiveSet(q).solve(e);
  EXPECT_EQ(a.active, b.active);
  EXPECT_TRUE(
      near(b.nodal, 1e6 * a.nodal, within(1e-12, "the same numbers but for rounding", 1e6 * a.nodal.maxCoeff())));
  EXPECT_TRUE(near(b.motion[0], 1e3 * a.motion[0], within(1e-12, "the same numbers but for rounding")));
  EXPECT_TRUE(near(b.motion[2], 1e3 / 1e5 * a.motion[2], within(1e-12, "the same numbers but for rounding")));
  EXPECT_TRUE(
      near(b.stiffness(0, 0), 1e3 * a.stiffness(0, 0), within(1e-12, "the same numbers but for rounding")));
}

TEST(ActiveSet, AnotherGapOnTheSameBodies)
{
  auto p = rough(150, 1, 4);
  ActiveSet kept(p);
  kept.solve({one(1.), {}});
  p.initial_gap = p.initial_gap.reverse().eval();
  kept.set_gap(p.initial_gap);
  const State warm = kept.solve({one(2.), {}}), fresh = ActiveSet(p).solve({one(2.), {}});
  EXPECT_EQ(warm.active, fresh.active);
  EXPECT_TRUE(near(warm.motion, fresh.motion, within(1e-12, "same equations")));
  kept.forget();
  EXPECT_TRUE(near(kept.solve({one(2.), {}}).motion, fresh.motion, within(1e-12, "same equations")));
}

TEST(ActiveSet, FlatPunchAllNodesTied)
{
  auto p             = grid(9, 9, 1e-3, 1e-3);
  const State s      = ActiveSet(p).solve({one(500.), {}});
  const auto uniform = p.C.llt().solve(Eigen::VectorXd::Ones(81)).eval();
  EXPECT_EQ(std::count(s.active.begin(), s.active.end(), 1), 81);
  EXPECT_TRUE(near(s.nodal, 500 * uniform / uniform.sum(), within(1e-12, "a plain linear solve")));
}

TEST(ActiveSet, OneNode)
{
  const Problem p{Eigen::MatrixXd::Constant(1, 1, 2.), Eigen::MatrixXd::Ones(1, 1), {}, one(0.5)};
  const State s = ActiveSet(p).solve({one(3.), {}});
  EXPECT_TRUE(near(s.motion[0], 6.5, within(1e-15, "0.5 + 2 times 3")));
  EXPECT_TRUE(near(s.compliance(0, 0), 2., within(1e-15, "one spring")));
  const State prescribed = ActiveSet(p).solve({one(2.5), {1}});
  EXPECT_TRUE(near(prescribed.resultant[0], 1., within(1e-15, "(2.5 - 0.5) / 2")));
}

TEST(ActiveSet, OpenGapIsAState)
{
  auto p = rough(30, 1, 2);
  p.initial_gap.array() += 1;
  ActiveSet solver(p);
  const State s = solver.solve({one(0.2), {1}});
  EXPECT_EQ(s.nodal.maxCoeff(), 0);
  EXPECT_EQ(s.resultant[0], 0);
  EXPECT_EQ(s.stiffness(0, 0), 0);
  EXPECT_TRUE(std::isinf(s.compliance(0, 0)));
  EXPECT_TRUE(near(s.gap, (p.initial_gap.array() - 0.2).matrix(), within(1e-15, "no load")));
  // Exactly touching, by motion and by a force of zero.
  const double touch = p.initial_gap.minCoeff();
  EXPECT_EQ(solver.solve({one(touch), {1}}).nodal.maxCoeff(), 0);
  EXPECT_EQ(solver.solve({one(0.), {}}).motion[0], touch);
  EXPECT_GT(solver.solve({one(touch + 1e-9), {1}}).resultant[0], 0);
}

TEST(ActiveSet, NodesThatTouchWithoutForceAreNoTrouble)
{
  // Two springs without coupling; the second closes exactly when the first carries 1 N.
  Problem p{Eigen::MatrixXd::Identity(2, 2), Eigen::MatrixXd::Ones(2, 1), {}, Eigen::Vector2d(0, 1)};
  const State s = ActiveSet(p).solve({one(1.), {}});
  EXPECT_TRUE(near(s.motion[0], 1., within(1e-15, "one spring at the end of its free travel")));
  EXPECT_TRUE(near(s.nodal, Eigen::Vector2d(1, 0), within(1e-15, "the second just touches", 1.)));
  EXPECT_LE(s.residual, 1e-15);
}

TEST(ActiveSet, RefusesLoadsWithoutEquilibrium)
{
  const auto p = rough(60, 2, 3);
  ActiveSet solver(p);
  const auto what = [&](const Eigen::Vector2d &resultant) -> std::string {
    try {
      solver.solve({resultant, {}});
    } catch (const mill::SolverError &e) {
      EXPECT_FALSE(e.report.remedy.empty());
      return e.report.what;
    }
    return "solved";
  };
  EXPECT_EQ(what({1, 1.01 * p.G.col(1).maxCoeff()}), "contact: the line of action lies outside the contact");
  EXPECT_EQ(what({1, 0.99 * p.G.col(1).maxCoeff()}), "solved");
  EXPECT_EQ(what({-1, 0}), "contact: the line of action lies outside the contact");
  EXPECT_EQ(what({0, 0}), "contact: nothing presses and nothing is held");
  auto single = rough(20, 1, 3);
  try {
    ActiveSet(single).solve({one(-1.), {}});
    FAIL() << "tension";
  } catch (const mill::SolverError &e) {
    EXPECT_EQ(e.report.what, "contact: the imposed resultant needs tension");
  }
}

TEST(ActiveSet, ForceOnTheVeryEdge)
{
  // Two springs of 1 N/m; the tilt closes the second only, which penetrates by 1 m to begin with.
  ActiveSet two(
      {Eigen::MatrixXd::Identity(2, 2), (Eigen::Matrix2d() << 1, 0, 1, 1).finished(), {}, Eigen::Vector2d(0, -1)});
  EXPECT_TRUE(
      near(two.solve({Eigen::Vector2d(1, 0.5), {}}).nodal, Eigen::Vector2d(0.5, 0.5), within(1e-14, "statics")));
  // All of the force over the first: the second carries nothing, for any tilt that keeps it open.
  const State edge = two.solve({Eigen::Vector2d(1, 0), {}});
  EXPECT_TRUE(near(edge.nodal, Eigen::Vector2d(1, 0), within(1e-14, "statics", 1.)));
  EXPECT_TRUE(near(edge.motion[0], 1., within(1e-14, "one spring")));
  EXPECT_LE(edge.motion.sum(), -1 + 1e-12);  // the second is open or just touches
}

TEST(ActiveSet, OneNodeCannotHoldATilt)
{
  ActiveSet solver({Eigen::MatrixXd::Identity(1, 1), Eigen::MatrixXd::Ones(1, 2), {}, one(0.)});
  const State s = solver.solve({Eigen::Vector2d(1, 1), {}});
  EXPECT_TRUE(near(s.nodal[0], 1., within(1e-14, "statics")));
  EXPECT_TRUE(std::isinf(s.compliance(1, 1)));
  EXPECT_TRUE(near(s.stiffness(0, 0), 1., within(1e-14, "one spring")));
}

TEST(ActiveSet, RefusesBadInput)
{
  const auto good  = rough(10, 1, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto bad         = good;
  bad.C(3, 3)      = nan;
  EXPECT_THROW(ActiveSet{bad}, mill::InputError);
  bad                = good;
  bad.initial_gap[0] = nan;
  EXPECT_THROW(ActiveSet{bad}, mill::InputError);
  bad         = good;
  bad.C(4, 4) = -1;
  EXPECT_THROW(ActiveSet{bad}, mill::InputError);
  bad = good;
  bad.initial_gap.conservativeResize(9);
  EXPECT_THROW(ActiveSet{bad}, mill::InputError);
  bad         = good;
  bad.C(2, 1) = bad.C(1, 2) = 5;  // symmetric, not positive definite
  EXPECT_THROW(ActiveSet(bad).solve({one(100.), {}}), mill::SolverError);
  ActiveSet solver(good);
  EXPECT_THROW(solver.solve({one(nan), {}}), mill::InputError);
  EXPECT_THROW(solver.solve({Eigen::Vector2d(1, 1), {}}), mill::InputError);
  EXPECT_THROW(solver.solve({one(1.), {}}, std::vector<char>(3, 1)), mill::InputError);
  EXPECT_THROW(solver.set_gap(Eigen::VectorXd::Constant(10, nan)), mill::InputError);
  EXPECT_LE(solver.solve({one(1.), {}}).residual, 1e-12);  // and still works
}
