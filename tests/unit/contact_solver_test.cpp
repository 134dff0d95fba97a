#include "fem/contact_solver.h"
#include "tests/support/near.h"
#include <Eigen/Cholesky>
#include <random>

using namespace mill::fem;

namespace {
// Positive definite operator with the decay of an elastic surface and a bowl-shaped gap.
ContactProblem bowl(const int n, const unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> noise(0, 1);
  ContactProblem p;
  p.C = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      p.C(i, j) = 1 / (0.5 + std::abs(i - j)) + (i == j ? 0.5 : 0);
  p.support     = Eigen::VectorXd::Constant(n, -0.01);
  p.initial_gap = Eigen::VectorXd::NullaryExpr(n, [&](const Eigen::Index i) {
    const double x = 2. * double(i) / n - 1;
    return 3 * x * x + 0.05 * noise(random);
  });
  p.initial_gap.array() -= p.initial_gap.minCoeff();
  return p;
}
}  // namespace

TEST(ContactSolver, SatisfiesTheComplementarityConditions)
{
  for (unsigned seed = 1; seed <= 20; ++seed)
    for (const double force : {0.01, 0.3, 5., 200.}) {
      const auto p = bowl(60, seed);
      const auto s = solve_contact(p, force);
      const Eigen::VectorXd gap =
          p.initial_gap + p.C * s.nodal + force * p.support - Eigen::VectorXd::Constant(60, s.q);
      EXPECT_GE(s.nodal.minCoeff(), 0) << "seed " << seed;
      EXPECT_GE(gap.minCoeff(), -1e-12 * s.q) << "seed " << seed;
      EXPECT_LE(s.nodal.cwiseProduct(gap).cwiseAbs().maxCoeff(), 1e-12 * force * s.q) << "seed " << seed;
      EXPECT_TRUE(near(s.nodal.sum(), force, within(1e-13, "equilibrium, a sum of 60 numbers")));
      EXPECT_LE(s.residual, 1e-12) << "seed " << seed;
    }
}

TEST(ContactSolver, AnswerDoesNotDependOnTheStart)
{
  const auto p    = bowl(80, 7);
  const auto cold = solve_contact(p, 2.);
  std::mt19937 random(11);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<char> start(80);
    for (char &a : start)
      a = random() % 2;
    start[random() % 80] = 1;
    const auto warm      = solve_contact(p, 2., start);
    EXPECT_EQ(warm.active, cold.active);
    EXPECT_TRUE(near(warm.q, cold.q, within(1e-13, "same equations")));
  }
  EXPECT_EQ(solve_contact(p, 2., cold.active).iterations, 1);
}

TEST(ContactSolver, TangentIsTheDerivative)
{
  const auto p        = bowl(80, 3);
  const auto s        = solve_contact(p, 2.);
  const double step   = 1e-6;
  const double higher = solve_contact(p, 2. + step, s.active).q, lower = solve_contact(p, 2. - step, s.active).q;
  EXPECT_TRUE(
      near(s.d_q, (higher - lower) / (2 * step), within(1e-8, "linear inside one active set, rounding / step")));
  EXPECT_TRUE(near(s.d_nodal.sum(), 1., within(1e-13, "the derivative carries the whole force")));
}

TEST(ContactSolver, FullContactIsAPlainLinearSolve)
{
  auto p = bowl(12, 5);
  p.initial_gap.setZero();
  const auto s               = solve_contact(p, 3.);
  const Eigen::VectorXd unit = p.C.llt().solve(Eigen::VectorXd::Ones(12));
  EXPECT_EQ(std::count(s.active.begin(), s.active.end(), 1), 12);
  EXPECT_TRUE(near(s.nodal, 3. * unit / unit.sum(), within(1e-12, "support is constant: a flat punch")));
}
