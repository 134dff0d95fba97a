// The bound on the acceleration that any force inside a range can cause.
#include "dynamics/response/frequency_response.h"
#include "dynamics/response/response.h"
#include "dynamics/response/time_integration.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "tests/support/reference.h"
#include <cmath>

using namespace mill;
using namespace mill::dynamics;

namespace {
MillModel model_of(const std::string &set)
{
  const auto chosen = parameter_set(set);
  return mill_model(chosen.stand, chosen.dynamics);
}
}  // namespace

TEST(LargestResponse, TwentySecondsOfEverySet)
{
  for (const char *set : {"P1", "P2", "P3", "P4", "Q1", "R1", "R2", "R3"}) {
    const auto expected          = reference("bound.any_force").at(set).get<std::vector<double>>();
    const Eigen::VectorXd result = largest_response(model_of(set), 6639.0 / 2, 20, 80e3);
    const Tolerance grid =
        within(0.02, "the reference samples the impulse response at 40 kHz, 11 points per period of "
                     "the highest mode");
    EXPECT_TRUE(near(result[upper_work_roll], expected[0], grid)) << set;
    EXPECT_TRUE(near(result[lower_work_roll], expected[1], grid)) << set;
  }
}

TEST(LargestResponse, LiteralDampingCannotReachThePublishedPeaks)
{
  const Eigen::VectorXd result = largest_response(model_of("P1"), 6639.0 / 2, 60, 80e3) / standard_gravity;
  EXPECT_TRUE(
      near(result[upper_work_roll], 1.01, within(0.02, "printed with three digits; time window and grid")));
  EXPECT_TRUE(
      near(result[lower_work_roll], 0.87, within(0.02, "printed with three digits; time window and grid")));
  const double published = reference("published.peaks").at("model")[0][0].get<double>() / standard_gravity;
  EXPECT_LT(result[upper_work_roll], published);
}

TEST(LargestResponse, IsReachedByTheForceThatSwitchesWithTheStepResponse)
{
  // For one end time T the worst force jumps between the ends of the range whenever the impulse response at T - t
  // changes sign.  As a polyline on a fine grid it comes close to the bound and never above it.
  const MillModel model   = model_of("R1");
  const StateSpace system = state_space(model);
  const double rate = 200e3, half = 3319.5;
  const Eigen::Index n = 200001;  // 1 s: the modes of this set have fallen to 1 % of their first swing
  ForceRecord step;
  step.time               = Eigen::Vector3d(0, 1e-9, 1.0);
  step.force              = Eigen::Vector3d(0, 1, 1);
  const Eigen::VectorXd s = first_order_hold(system, step, rate).output.row(upper_work_roll);
  ForceRecord worst{Eigen::ArrayXd::LinSpaced(n, 0, double(n - 1)) / rate, Eigen::VectorXd(n), {}};
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    worst.force[n - 2 - i] = s[i + 1] > s[i] ? half : -half;
  worst.force[n - 1]   = half;  // the jump D > 0 of the acceleration itself
  const double reached = mill_response(model, worst, rate).acceleration(n - 1, upper_work_roll);
  const double bound   = largest_response(model, half, 20, rate)[upper_work_roll];
  EXPECT_LT(reached, bound);
  EXPECT_GT(reached, 0.9 * bound) << "1 s of 20, and the start of the force is not the end of the range";
}
