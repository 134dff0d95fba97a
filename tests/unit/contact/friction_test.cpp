#include "core/base/errors.h"
#include "fem/contact/active_set.h"
#include "fem/contact/friction.h"
#include "fem/contact/hertz.h"
#include "tests/support/contact_problems.h"
#include "tests/support/near.h"
#include <Eigen/LU>

using namespace mill::contact;
using namespace contact_problems;

namespace {
// Cylinder of radius 50 mm on a flat, equal half planes, 1000 N/mm: half width 0.743 mm; n strips.
FrictionProblem cylinder(const int n, const double mu)
{
  const auto bodies = half_spaces(steel, steel);
  const double half = 0.85e-3 / n;
  FrictionProblem p{Eigen::MatrixXd::Zero(2 * n, 2 * n),
                    Eigen::MatrixXd::Zero(2 * n, 2),
                    {},
                    Eigen::VectorXd(n),
                    Eigen::VectorXd::Constant(n, mu)};
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Eigen::Matrix2d k = strip_influence(bodies, half, 2 * half * (i - j), 0.1);
      p.C(i, j)               = k(1, 1) / (2 * half);
      p.C(n + i, n + j)       = k(0, 0) / (2 * half);
    }
    const double x   = (2 * i - n + 1) * half;
    p.initial_gap[i] = x * x / (2 * 0.050);
  }
  p.G.col(0).head(n).setOnes();
  p.G.col(1).tail(n).setOnes();
  return p;
}

// n points, d tangents, all components coupled.
FrictionProblem coupled(const int n, const int d, const double mu, const unsigned seed)
{
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto shape  = rough(n, 1, seed);
  Eigen::MatrixXd B = Eigen::MatrixXd::Identity(1 + d, 1 + d) +
                      0.3 * Eigen::MatrixXd::NullaryExpr(1 + d, 1 + d, [&] { return normal(random); });
  B           = (B * B.transpose()).eval();
  const int N = n * (1 + d);
  FrictionProblem p{Eigen::MatrixXd(N, N),
                    Eigen::MatrixXd::Zero(N, 1 + d),
                    {},
                    shape.initial_gap,
                    Eigen::VectorXd::Constant(n, mu)};
  for (int a = 0; a <= d; ++a) {
    for (int b = 0; b <= d; ++b)
      p.C.block(a * n, b * n, n, n) = B(a, b) * shape.C;
    p.G.col(a).segment(a * n, n).setOnes();
  }
  return p;
}

int count(const FrictionState &s, const Status status)
{
  return int(std::count(s.status.begin(), s.status.end(), status));
}
}  // namespace

TEST(Friction, WithoutFrictionItIsTheNormalContact)
{
  const int n  = 101;
  const auto p = cylinder(n, 0);
  FrictionSolver solver(p);
  const auto s = solver.advance({Eigen::Vector2d(1e6, 3e-6), {0, 1}});
  const State exact =
      ActiveSet({p.C.topLeftCorner(n, n), Eigen::MatrixXd::Ones(n, 1), {}, p.initial_gap}).solve({one(1e6), {}});
  EXPECT_TRUE(near(s.nodal.head(n), exact.nodal, within(1e-12, "same equations", exact.nodal.maxCoeff())));
  EXPECT_TRUE(near(s.motion[0], exact.motion[0], within(1e-12, "same equations")));
  EXPECT_TRUE(near(s.stiffness(0, 0), exact.stiffness(0, 0), within(1e-12, "same equations")));
  EXPECT_EQ(s.resultant[1], 0);
  EXPECT_EQ(s.dissipated, 0);
  EXPECT_EQ(count(s, Status::stick), 0);
}

TEST(Friction, WithMuchFrictionItIsBonded)
{
  // Everything that touches sticks: one linear system for all components, solved here apart.
  for (const int d : {1, 2}) {
    const auto p = coupled(15, d, 100, 4);
    FrictionSolver solver(p);
    Loading loading{Eigen::VectorXd::Constant(1 + d, 0.2), std::vector<char>(1 + d, 1)};
    loading.value[0] = 3;
    const auto s     = solver.advance(loading);
    ASSERT_EQ(count(s, Status::slip), 0);
    ASSERT_GE(count(s, Status::stick), 8);
    std::vector<int> held;  // components of the nodes that touch
    for (int c = 0; c <= d; ++c)
      for (int i = 0; i < 15; ++i)
        if (s.status[i] == Status::stick)
          held.push_back(c * 15 + i);
    Eigen::VectorXd gap     = Eigen::VectorXd::Zero(p.C.rows());
    gap.head(15)            = p.initial_gap;
    const Eigen::MatrixXd C = p.C(held, held), G = p.G(held, Eigen::all);
    const Eigen::VectorXd exact = C.partialPivLu().solve(Eigen::VectorXd(G * loading.value - gap(held)));
    const auto reason           = within(1e-10, "condition of C about 1e3", exact.cwiseAbs().maxCoeff());
    EXPECT_TRUE(near(Eigen::VectorXd(s.nodal(held)), exact, reason));
    const Eigen::MatrixXd stiffness = G.transpose() * C.partialPivLu().solve(G);
    for (int j = 0; j <= d; ++j)
      EXPECT_TRUE(near(s.stiffness.col(j), stiffness.col(j),
                       within(1e-10, "condition of C about 1e3", stiffness.cwiseAbs().maxCoeff())));
  }
}

TEST(Friction, OneNodeByHand)
{
  // Springs 1 N/m in both directions, mu 0.5.
  const FrictionProblem p{Eigen::MatrixXd::Identity(2, 2), Eigen::MatrixXd::Identity(2, 2), {}, one(0.), one(0.5)};
  FrictionSolver solver(p);
  auto s = solver.advance({Eigen::Vector2d(2, 0.4), {1, 1}});
  EXPECT_EQ(s.status[0], Status::stick);
  EXPECT_TRUE(near(s.nodal, Eigen::Vector2d(2, 0.4), within(1e-14, "two springs")));
  s = solver.advance({Eigen::Vector2d(2, 3), {1, 1}});
  EXPECT_EQ(s.status[0], Status::slip);
  EXPECT_TRUE(near(s.nodal, Eigen::Vector2d(2, 1), within(1e-14, "mu p")));
  EXPECT_TRUE(near(s.slip[0], 2., within(1e-14, "3 m less the spring")));
  EXPECT_TRUE(near(s.dissipated, 2., within(1e-14, "1 N along 2 m")));
  EXPECT_TRUE(near(s.stiffness(1, 0), 0.5, within(1e-14, "mu times the normal stiffness")));
  EXPECT_EQ(s.stiffness(1, 1), 0);
  s = solver.advance({Eigen::Vector2d(2, 1.5), {1, 1}});  // back by 1.5: the spring turns over, no slip yet
  EXPECT_EQ(s.status[0], Status::stick);
  EXPECT_TRUE(near(s.nodal[1], -0.5, within(1e-14, "1 - 1.5")));
  EXPECT_TRUE(near(s.slip[0], 2., within(1e-14, "kept")));
  s = solver.advance({Eigen::Vector2d(2, 0), {1, 1}});
  EXPECT_TRUE(near(s.nodal[1], -1., within(1e-14, "- mu p")));
  EXPECT_TRUE(near(s.slip[0], 1., within(1e-14, "slipped back by 1")));
  s = solver.advance({Eigen::Vector2d(-1, 0), {1, 1}});
  EXPECT_EQ(s.status[0], Status::open);
  EXPECT_EQ(s.nodal.norm(), 0);
}

TEST(Friction, ConditionsHoldAndNoWorkIsGained)
{
  int n_slip = 0, n_stick = 0;
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const int d = 1 + int(seed % 2);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1, 1);
    const int n  = 12;
    const auto p = coupled(n, d, 0.05 + 0.4 * std::abs(u(random)), seed);
    FrictionSolver solver(p);
    for (int step = 0; step < 5; ++step) {
      Loading loading{Eigen::VectorXd(1 + d), std::vector<char>(1 + d, 1)};
      loading.value[0] = 0.8 + 0.4 * u(random);
      for (int c = 1; c <= d; ++c)
        loading.value[c] = 0.5 * u(random);
      const auto before = solver.state();
      const auto s      = solver.advance(loading);
      EXPECT_LE(s.residual, 1e-11) << "seed " << seed << " step " << step;
      EXPECT_GE(s.dissipated, 0) << "seed " << seed << " step " << step;
      // The conditions from the answer alone.
      const Eigen::VectorXd opening = p.C * s.nodal - p.G * s.motion;
      for (int i = 0; i < n; ++i) {
        double t = 0, moved = 0, along = 0;
        for (int c = 1; c <= d; ++c) {
          const double slip = -opening[c * n + i] - before.slip[(c - 1) * n + i];
          t += s.nodal[c * n + i] * s.nodal[c * n + i];
          moved += slip * slip;
          along += slip * s.nodal[c * n + i];
        }
        t              = std::sqrt(t);
        moved          = std::sqrt(moved);
        const double f = p.mu[i] * s.nodal[i];
        EXPECT_GE(opening[i] + p.initial_gap[i], -1e-11);
        EXPECT_LE(t, f + 1e-11);
        if (s.status[i] == Status::stick)
          EXPECT_LE(moved, 1e-11);
        if (s.status[i] == Status::slip) {
          EXPECT_TRUE(
              near(t, f, within_absolute(1e-11, "the conditions hold to the rounding of loads of order one")));
          EXPECT_TRUE(near(along, t * moved,
                           within_absolute(1e-11, "the conditions hold to the rounding of loads of order one")));
        }
      }
      n_slip += count(s, Status::slip);
      n_stick += count(s, Status::stick);
    }
  }
  EXPECT_GT(n_slip, 100);
  EXPECT_GT(n_stick, 100);
}

TEST(Friction, SwitchedOffItChangesTheAnswer)
{
  const auto with = coupled(20, 1, 0.3, 7), without = coupled(20, 1, 0, 7);
  const Loading loading{Eigen::Vector2d(1., 0.4), {1, 1}};
  FrictionSolver a(with), b(without);
  const auto rough_one = a.advance(loading), smooth = b.advance(loading);
  EXPECT_GT(std::abs(rough_one.resultant[1]), 0.05 * rough_one.resultant[0]);
  EXPECT_EQ(smooth.resultant[1], 0);
  EXPECT_GT(std::abs(rough_one.resultant[0] / smooth.resultant[0] - 1),
            1e-3);  // and through the coupling the normal force
}

TEST(Friction, TheLoadPathMatters)
{
  // Cattaneo, unloaded and reversed: Mindlin and Deresiewicz (1953).  From Q to -Q the state is the mirror image
  // of that at Q; on the way, at zero, tractions and slip remain.
  const int n = 101;
  FrictionSolver solver(cylinder(n, 0.3));
  const double P = 1e6, Q = 0.5 * 0.3 * P;
  solver.advance({Eigen::Vector2d(P, 0), {}});
  const auto position = solver.advance({Eigen::Vector2d(P, Q), {}});
  const auto at_zero  = solver.advance({Eigen::Vector2d(P, 0), {}});
  EXPECT_GT(at_zero.nodal.tail(n).cwiseAbs().maxCoeff(), 0.05 * position.nodal.tail(n).maxCoeff());
  EXPECT_GT(at_zero.motion[1], 0);
  const auto reversed = solver.advance({Eigen::Vector2d(P, -Q), {}});
  EXPECT_TRUE(near(reversed.nodal.tail(n), -position.nodal.tail(n),
                   within(1e-10, "exact in the closed form and on the grid: the middle that stuck sticks",
                          position.nodal.tail(n).maxCoeff())));
  EXPECT_TRUE(near(reversed.motion[1], -position.motion[1], within(1e-10, "mirror image")));
}

TEST(Friction, TangentIsTheDerivativeOfTheStep)
{
  int checked[3] = {0, 0, 0};
  for (unsigned seed = 1; seed <= 16; ++seed) {
    const int d  = 1 + int(seed % 2);
    const auto p = coupled(14, d, 0.4, seed);
    FrictionSolver first(p);
    Loading start{Eigen::VectorXd::Zero(1 + d), std::vector<char>(1 + d, 1)};
    start.value[0] = 1;
    Loading end    = start;
    for (int c = 1; c <= d; ++c)
      end.value[c] = 0.1 * c;
    first.advance(start);
    const auto s = first.advance(end);
    if (count(s, Status::slip) < 2 || count(s, Status::stick) < 2)
      continue;
    ++checked[d];
    for (int j = 0; j <= d; ++j) {
      const double step = 1e-6;
      Eigen::VectorXd moved[2];
      for (const int side : {0, 1}) {
        FrictionSolver again(p);
        Loading other = end;
        other.value[j] += side ? step : -step;
        again.advance(start);
        const auto near_by = again.advance(other);
        ASSERT_EQ(near_by.status, s.status);
        moved[side] = near_by.resultant;
      }
      EXPECT_TRUE(near(s.stiffness.col(j), (moved[1] - moved[0]) / (2 * step),
                       within(1e-6, "step squared in space, rounding / step", s.stiffness.cwiseAbs().maxCoeff())));
    }
  }
  EXPECT_GE(checked[1], 2);
  EXPECT_GE(checked[2], 2);
}

TEST(Friction, ReportsSlidingOfTheWholeContact)
{
  FrictionSolver solver(cylinder(61, 0.3));
  solver.advance({Eigen::Vector2d(1e6, 0), {}});
  const double good = solver.advance({Eigen::Vector2d(1e6, 0.29e6), {}}).motion[1];
  try {
    solver.advance({Eigen::Vector2d(1e6, 0.31e6), {}});
    FAIL() << "beyond mu P";
  } catch (const mill::SolverError &e) {
    EXPECT_EQ(e.report.what, "friction: the bodies slide");
  }
  EXPECT_EQ(solver.state().motion[1], good);  // stays where it was
  const auto s = solver.advance({Eigen::Vector2d(1e6, 1e-3), {0, 1}});
  EXPECT_TRUE(near(s.resultant[1], 0.3e6, within(1e-12, "mu P while it slides")));
}

TEST(Friction, RefusesBadInput)
{
  const auto good = coupled(6, 1, 0.3, 1);
  auto bad        = good;
  bad.mu[2]       = -0.1;
  EXPECT_THROW(FrictionSolver{bad}, mill::InputError);
  bad         = good;
  bad.C(0, 0) = std::nan("");
  EXPECT_THROW(FrictionSolver{bad}, mill::InputError);
  bad = good;
  bad.initial_gap.conservativeResize(5);
  EXPECT_THROW(FrictionSolver{bad}, mill::InputError);
  FrictionSolver solver(good);
  EXPECT_THROW(solver.advance({one(1.), {}}), mill::InputError);
  EXPECT_THROW(solver.advance({Eigen::Vector2d(std::nan(""), 0), {}}), mill::InputError);
}
