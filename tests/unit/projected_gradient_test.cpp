#include "contact/active_set.h"
#include "contact/projected_gradient.h"
#include "core/errors.h"
#include "tests/support/contact_problems.h"
#include "tests/support/near.h"

using namespace mill::contact;
using namespace contact_problems;

namespace {
OperatorProblem operator_of(const Problem &p)
{
  return {[&p](const Eigen::VectorXd &x) { return Eigen::VectorXd(p.C * x); }, p.G.col(0), p.initial_gap};
}
}  // namespace

TEST(ProjectedGradient, AgreesWithTheActiveSet)
{
  for (const auto &p : {sphere(24, 0.5e-3), rough(300, 1, 3), grid(12, 12, 1e-3, 1e-3)}) {
    const double closed = p.C.mean();
    for (const double force : {0.05, 1., 20.}) {
      const double load   = force * (p.initial_gap.mean() + 1e-6) / closed;
      const State exact   = ActiveSet(p).solve({one(load), {}});
      const auto by_force = contact_by_projection(operator_of(p), load, false);
      EXPECT_EQ(by_force.active, exact.active);
      EXPECT_LE(by_force.residual, 1e-12);
      EXPECT_TRUE(near(by_force.motion, exact.motion[0], within(1e-9, "residual times the condition of C, 1e3")));
      EXPECT_TRUE(near(by_force.nodal, exact.nodal,
                       within(1e-9, "residual times the condition of C, 1e3", exact.nodal.maxCoeff())));
      const auto by_motion = contact_by_projection(operator_of(p), exact.motion[0], true);
      EXPECT_EQ(by_motion.active, exact.active);
      EXPECT_TRUE(near(by_motion.resultant, load, within(1e-9, "residual times the condition of C, 1e3")));
    }
  }
}

TEST(ProjectedGradient, AStartFromTheLastLoadCostsLess)
{
  const auto p    = sphere(24, 0.5e-3);
  const auto op   = operator_of(p);
  const auto last = contact_by_projection(op, 900, false);
  const auto cold = contact_by_projection(op, 901, false),
             warm = contact_by_projection(op, 901, false, last.nodal);
  EXPECT_LT(warm.products, cold.products);
  EXPECT_TRUE(near(warm.motion, cold.motion, within(1e-12, "both end on the exact set")));
}

TEST(ProjectedGradient, OpenTensionAndBadInput)
{
  auto p = rough(30, 1, 2);
  p.initial_gap.array() += 1;
  const auto op   = operator_of(p);
  const auto open = contact_by_projection(op, 0.1, true);
  EXPECT_EQ(open.resultant, 0);
  EXPECT_EQ(open.products, 0);
  EXPECT_THROW(contact_by_projection(op, -1, false), mill::SolverError);
  EXPECT_THROW(contact_by_projection(op, 5, false, {}, 3), mill::SolverError);
  EXPECT_THROW(contact_by_projection(op, std::nan(""), true), mill::InputError);
  EXPECT_THROW(contact_by_projection(op, 1, false, Eigen::VectorXd::Ones(4)), mill::InputError);
}
