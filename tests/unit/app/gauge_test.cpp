// PL-2: what moves the thickness, with the exact derivatives of a slab theory, against the coupled solution.
#include "reduce/bite/slab/slab_bite.h"
#include "reduce/chain/line_contact.h"
#include "reduce/chain/mill_modulus.h"
#include "tests/support/demo_pass.h"
#include "tests/support/near.h"
#include <functional>

using namespace mill;
using namespace mill::bite;

namespace {
BiteState solved(const RollBite &bite)
{
  return solve_slab(bite, {Theory::bland_ford, Arc::rigid, 0});
}

// Springs of a frame and two contacts of rolls.
double stretch(const double F)
{
  return F / 5e9 + 2 * reduce::line_contact({0.42, 1.45, 1.4, {2.1e11, 0.28, 7700}}, F).approach;
}

double rolled(RollBite bite, const double screw)
{
  const double h2  = bite.strip.exit_thickness;
  const auto force = [&](const double h) {
    bite.strip.exit_thickness = h;
    return solved(bite).force;
  };
  return reduce::coupled_thickness(screw, force, stretch, 0.98 * h2, 1.02 * h2);
}
}  // namespace

TEST(Gauge, DerivativesAgreeWithDifferencesOfTheCoupledSolution)
{
  const RollBite bite   = demo_pass();
  const BiteState state = solved(bite);
  const double S        = bite.strip.exit_thickness - stretch(state.force);
  const double contact  = reduce::line_contact({0.42, 1.45, 1.4, {2.1e11, 0.28, 7700}}, state.force).tangent;
  const reduce::GaugeCoupling gauge{1 / (1 / 5e9 + 2 / contact), -by(state.force_by, Input::exit_thickness)};
  const auto differences = within(1e-6, "central differences of a solution to 1e-15");
  const double d         = 1e-7;
  EXPECT_TRUE(near(gauge.screw(), (rolled(bite, S + d) - rolled(bite, S - d)) / (2 * d), differences));
  const auto moved = [&](const std::function<void(RollBite &, double)> &move, const double step) {
    RollBite up = bite, down = bite;
    move(up, step);
    move(down, -step);
    return (rolled(up, S) - rolled(down, S)) / (2 * step);
  };
  const auto by_input = [&](const Input input) { return gauge.thickness_by(by(state.force_by, input)); };
  EXPECT_TRUE(near(by_input(Input::entry_thickness),
                   moved([](RollBite &b, double x) { b.strip.entry_thickness += x; }, d), differences));
  EXPECT_TRUE(near(by_input(Input::entry_tension),
                   moved([](RollBite &b, double x) { b.strip.entry_tension += x; }, 1e3), differences));
  EXPECT_TRUE(near(by_input(Input::exit_tension),
                   moved([](RollBite &b, double x) { b.strip.exit_tension += x; }, 1e3), differences));
  EXPECT_TRUE(near(by_input(Input::friction),
                   moved([](RollBite &b, double x) { b.strip.friction.coefficient += x; }, 1e-5), differences));
  EXPECT_TRUE(near(by_input(Input::flow_stress),
                   moved([](RollBite &b, double x) { b.strip.flow_stress.k *= 1 + x; }, 1e-5), differences));
}
