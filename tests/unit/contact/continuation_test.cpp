#include "core/base/errors.h"
#include "fem/contact/continuation.h"
#include "fem/contact/set_by_continuation.h"
#include "tests/support/contact_problems.h"
#include "tests/support/near.h"

using namespace mill::contact;
using namespace contact_problems;

namespace {
Loading between(const Loading &a, const Loading &b, const double place)
{
  Loading out = a;
  out.value   = (1 - place) * a.value + place * b.value;
  return out;
}
}  // namespace

TEST(Continuation, AgreesWithTheActiveSetAtEverySample)
{
  for (unsigned seed = 1; seed <= 12; ++seed) {
    auto p = rough(70, 2, seed);
    if (seed % 3 == 0)
      p.W = 0.1 * p.G;
    const bool prescribed = seed % 2;
    Loading from{Eigen::Vector2d(0.4, -0.05), {}}, to{Eigen::Vector2d(4., 0.8), {}};
    if (prescribed) {
      from = {Eigen::Vector2d(0.1, 0.2), {1, 1}};
      to   = {Eigen::Vector2d(1.5, -0.3), {1, 1}};
    }
    ActiveSet solver(p);
    const Path path = follow(solver, from, to);
    ASSERT_GE(path.events.size(), 10u) << "a path on which something happens";
    for (const double place : {0., 0.111, 0.3, 0.57, 0.93, 1.}) {
      const State exact     = ActiveSet(p).solve(between(from, to, place));
      const PathPoint point = sample(path, place);
      EXPECT_TRUE(near(point.motion, exact.motion, within(1e-10, "same equations", exact.motion.norm())));
      EXPECT_TRUE(near(point.resultant, exact.resultant, within(1e-10, "same equations", exact.resultant.norm())));
    }
    // The set it leaves behind is that of the end.
    EXPECT_EQ(solver.solve(to).iterations, 1) << "seed " << seed;
  }
}

TEST(Continuation, TangentIsTheCentralDifferenceOfTheCurve)
{
  auto p = sphere(16, 0.45e-3);
  ActiveSet solver(p);
  const Path path = follow(solver, {one(0.), {}}, {one(1000.), {}});
  for (std::size_t i = 1; i + 1 < path.events.size(); i += 4) {
    const Event &a = path.events[i], &b = path.events[i + 1];
    if (b.position - a.position < 1e-6)
      continue;
    const double mid = (a.position + b.position) / 2, step = (b.position - a.position) / 4;
    const PathPoint low = sample(path, mid - step), high = sample(path, mid + step);
    const double slope = (high.resultant[0] - low.resultant[0]) / (high.motion[0] - low.motion[0]);
    EXPECT_TRUE(near(sample(path, mid).stiffness(0, 0), slope, within(1e-6, "rounding of a short piece")));
    EXPECT_TRUE(near(a.stiffness_after(0, 0), b.stiffness_before(0, 0), within(1e-12, "one piece, one slope")));
    // A loaded sphere only gains nodes: the contact gets stiffer at every event.
    EXPECT_GE(b.stiffness_after(0, 0), b.stiffness_before(0, 0) * (1 - 1e-12)) << i;
  }
}

TEST(Continuation, ThereAndBackIsTheSameCurve)
{
  const auto p = rough(60, 1, 9);
  ActiveSet solver(p);
  const Loading low{one(0.1), {}}, high{one(5.), {}};
  const Path up = follow(solver, low, high), down = follow(solver, high, low);
  for (const double place : {0.05, 0.21, 0.5, 0.87})
    EXPECT_TRUE(
        near(sample(up, place).motion, sample(down, 1 - place).motion, within(1e-12, "contact without friction")));
}

TEST(Continuation, TiesDoNotCycle)
{
  // All nodes of a flat punch touch at once.
  const auto p = grid(7, 7, 1e-3, 1e-3);
  ActiveSet punch(p);
  const Path flat = follow(punch, {one(-1e-6), {1}}, {one(1e-6), {1}});
  ASSERT_EQ(flat.events.size(), 3u);
  EXPECT_TRUE(near(flat.events[1].position, 0.5, within(1e-12, "half way")));
  EXPECT_EQ(flat.events[1].entered.size(), 49u);
  EXPECT_EQ(flat.events[1].stiffness_before(0, 0), 0);
  EXPECT_GT(flat.events[1].stiffness_after(0, 0), 0);

  // Rings of a sphere close four or eight at a time, and open again, down to nothing.
  auto q = sphere(9, 0.3e-3);
  ActiveSet ball(q);
  const Path there = follow(ball, {one(-1e-6), {1}}, {one(3e-6), {1}});
  const Path back  = follow(ball, {one(3e-6), {1}}, {one(-1e-6), {1}});
  EXPECT_EQ(there.events.size(), back.events.size());
  EXPECT_EQ(there.events[1].entered.size(), 1u);
  EXPECT_EQ(there.events[2].entered.size() % 4, 0u);
  EXPECT_EQ(back.events.back().resultant[0], 0);
  EXPECT_EQ(back.events.back().stiffness_after(0, 0), 0);
}

TEST(Continuation, EventsOfTwoSprings)
{
  // Springs of 1 N/m without coupling; the second closes after 1 m: stiffness 1, then 2.
  ActiveSet solver({Eigen::MatrixXd::Identity(2, 2), Eigen::MatrixXd::Ones(2, 1), {}, Eigen::Vector2d(0, 1)});
  const Path path = follow(solver, {one(0.), {}}, {one(4.), {}});
  ASSERT_EQ(path.events.size(), 3u);
  const Event &e = path.events[1];
  EXPECT_TRUE(near(e.position, 0.25, within(1e-14, "1 N of 4 N")));
  EXPECT_TRUE(near(e.motion[0], 1., within(1e-14, "its free travel")));
  EXPECT_EQ(e.entered, std::vector<int>{1});
  EXPECT_TRUE(near(e.stiffness_before(0, 0), 1., within(1e-14, "one spring")));
  EXPECT_TRUE(near(e.stiffness_after(0, 0), 2., within(1e-14, "two springs")));
  EXPECT_TRUE(near(path.events[2].motion[0], 2.5, within(1e-14, "1 m + 3 N / 2 N/m")));
}

TEST(Continuation, FindsTheSetWithoutExchange)
{
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const auto p      = rough(60, 3, seed);
    const double far  = p.G.rightCols(2).cwiseAbs().maxCoeff();
    const double side = seed % 2 ? 0.6 : -0.3;
    Loading loading{Eigen::Vector3d(2, 2 * side * far, 0.2), {0, 0, char(seed % 3 == 0)}};
    ActiveSet solver(p);
    const State exact = solver.solve(loading);
    std::vector<char> set(60, 0);
    for (const int i : set_by_continuation(p, solver.modes(), scaled(loading, solver.modes())))
      set[i] = 1;
    EXPECT_EQ(set, exact.active) << "seed " << seed;
  }
}

TEST(Continuation, ReportsWhereABodyTipsOver)
{
  auto p = rough(50, 2, 6);
  ActiveSet solver(p);
  const double edge = p.G.col(1).maxCoeff();
  try {
    follow(solver, {Eigen::Vector2d(1, 0), {}}, {Eigen::Vector2d(1, 2 * edge), {}});
    FAIL() << "the line of action leaves the nodes half way";
  } catch (const mill::SolverError &e) {
    EXPECT_EQ(e.report.what, "contact: the path ends before its end");
    EXPECT_FALSE(e.report.remedy.empty());
  }
  EXPECT_THROW(follow(solver, {Eigen::Vector2d(1, 0), {}}, {Eigen::Vector2d(1, 0), {1, 0}}), mill::InputError);
  const Path path = follow(solver, {Eigen::Vector2d(1, 0), {}}, {Eigen::Vector2d(1, 0.5 * edge), {}});
  EXPECT_THROW(sample(path, 1.5), mill::InputError);
}
