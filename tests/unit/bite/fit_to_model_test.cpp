#include "core/base/errors.h"
#include "reduce/bite/fit/fit_to_model.h"
#include "reduce/bite/fit/identify.h"
#include "reduce/bite/slab/bland_ford.h"
#include "tests/support/near.h"
#include <cmath>
#include <gtest/gtest.h>

// A fit whose force comes from another model than the slab.
namespace {
using namespace mill;
using bite::Measured;

struct HotPass {
  double entry, exit;  // m
};
constexpr HotPass thick{8e-3, 5e-3};
// Karman's slab sticks everywhere and no longer depends on friction, while Bland and Ford's force rises with it.
constexpr HotPass thin{2e-3, 1.4e-3};

bite::RollBite hot_pass(const HotPass &pass, const double friction)
{
  bite::RollBite b;
  b.roll_radius                = 0.21;
  b.roll                       = {210e9, 0.3};
  b.roll_speed                 = 2;
  b.strip.width                = 1;
  b.strip.entry_thickness      = pass.entry;
  b.strip.exit_thickness       = pass.exit;
  b.strip.flow_stress.law      = FlowStressLaw::constant;
  b.strip.flow_stress.k        = 60e6;
  b.strip.friction.coefficient = friction;
  return b;
}

double bland_ford_force(const HotPass &pass, const double friction)
{
  return solve_bland_ford(hot_pass(pass, friction), bite::Arc::rigid).force;
}

bite::FitAnswer fitted_by_slab(const HotPass &pass, const double force, const double guess)
{
  bite::MeasuredPass measured;
  measured.name         = "a";
  measured.bite         = hot_pass(pass, guess);
  measured.value[0]     = force;
  measured.deviation[0] = 0.02 * force;
  bite::FitProblem problem;
  problem.arc      = bite::Arc::rigid;
  problem.unknowns = {bite::fit_unknown("friction")};
  problem.passes   = {measured};
  return bite::identify(problem, true);
}
}  // namespace

TEST(FitToModel, FindsTheFrictionThatTheModelWasComputedWith)
{
  constexpr double guess = 0.2;
  for (const HotPass &pass : {thick, thin})
    for (const double truth : {0.15, 0.276}) {
      bite::FitAnswer answer = fitted_by_slab(pass, bland_ford_force(pass, truth), guess);
      int calls              = 0;
      const auto model       = [&](const Eigen::VectorXd &x) {
        ++calls;
        const double force = bland_ford_force(pass, guess * std::exp(x[0]));
        return std::vector<Eigen::Vector3d>{{force, not_given, not_given}};
      };
      const bite::FitPoint best = fit_to_model(answer.problem, answer.best, model);
      EXPECT_TRUE(near(guess * std::exp(best.x[0]), truth,
                       within(1e-3, "a hundredth of 2 % of the force, over its exponent by friction of 0.2")));
      EXPECT_LE(calls, 12) << "the secant converges faster than linearly";
    }
}

TEST(FitToModel, RefusesAForceThatTheModelNeverReaches)
{
  constexpr double guess = 0.15;
  bite::FitAnswer answer = fitted_by_slab(thick, bland_ford_force(thick, 0.276), guess);
  // A model that jumps over the measured force settles nowhere.
  const auto model = [&](const Eigen::VectorXd &x) {
    const double force = bland_ford_force(thick, guess * std::exp(x[0]));
    return std::vector<Eigen::Vector3d>{{x[0] < 0.3 ? 0.8 * force : 1.3 * force, not_given, not_given}};
  };
  try {
    fit_to_model(answer.problem, answer.best, model);
    FAIL() << "settled";
  } catch (const SolverError &e) {
    EXPECT_EQ(e.report.what, "bite.fit: the model of the run does not settle on the measured values");
    EXPECT_NE(e.report.remedy.find("bite.fit_for"), std::string::npos);
  }
}
