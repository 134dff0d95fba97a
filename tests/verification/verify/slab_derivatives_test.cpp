// Every derivative of the closed slab theories, against differences of whole solutions and against complex step.
#include "reduce/bite/slab/bland_ford.h"
#include "reduce/bite/slab/hu_ehmann.h"
#include "reduce/bite/slab/slab_bite.h"
#include "tests/manual/solvers/moved_bite.h"
#include "tests/support/demo_pass.h"
#include "tests/support/film_pass.h"
#include "tests/support/near.h"

using namespace mill;
using namespace mill::bite;

namespace {
/// The bite with one input moved, on a rigid arc of the state's radius.
RollBite moved(RollBite bite, const double radius, const Input which, const double by)
{
  bite.roll_radius = radius;
  return moved_bite(bite, which, by);
}

void expect_differences(const RollBite &bite, const Theory theory, const Arc arc)
{
  const BiteState state = solve_slab(bite, {theory, arc, 0});
  const double scale[]  = {
       bite.strip.entry_thickness, bite.strip.exit_thickness, 1e8, 1e8, 0.1, 1, state.flattened_radius, 10, 0.1};
  for (int i = 0; i < n_inputs; ++i) {
    if (std::isnan(bite.roll_speed) && i >= int(Input::roll_speed)) {
      EXPECT_TRUE(std::isnan(state.force_by[i]));
      continue;
    }
    // The curvature of the force by the gap is large on thin strip; hence a small step there.
    const double step = 2e-6 * scale[i];
    double F[2], T[2];
    for (const int side : {0, 1}) {
      const BiteState s =
          solve_slab(moved(bite, state.flattened_radius, Input(i), side ? step : -step), {theory, Arc::rigid, 0});
      const double arm =
          i == int(Input::arc_radius) ? state.flattened_radius + (side ? step : -step) : state.flattened_radius;
      F[side] = s.force;
      T[side] = s.torque / arm * bite.roll_radius;  // the torque's arm is the roll that is not flattened
    }
    const auto difference = within(1e-6, "central difference: truncation 1e-8, rounding 1e-9 of force over change",
                                   1e-3 * state.force / scale[i]);
    EXPECT_TRUE(near(state.force_by[i], (F[1] - F[0]) / (2 * step), difference)) << "force by input " << i;
    const auto of_torque = within(1e-6, "as the force", 1e-3 * state.force * bite.roll_radius * 0.1 / scale[i]);
    EXPECT_TRUE(near(state.torque_by[i], (T[1] - T[0]) / (2 * step), of_torque)) << "torque by input " << i;
  }
}
}  // namespace

TEST(SlabDerivatives, BlandFordWithCoulombFriction)
{
  expect_differences(demo_pass(), Theory::bland_ford, Arc::rigid);
  RollBite bite            = demo_pass();
  bite.roll_speed          = 2;
  bite.gap_rate            = 0.01;
  bite.strip.entry_tension = 2e6;
  bite.strip.flow_stress   = {FlowStressLaw::voce, 10e6, 0, 3, 25e6, {}};
  expect_differences(bite, Theory::bland_ford, Arc::hitchcock);
}

TEST(SlabDerivatives, BlandFordUnderAFilmWithAMovingGap)
{
  RollBite bite = film_pass();
  expect_differences(bite, Theory::bland_ford, Arc::hitchcock);
  bite.gap_rate = -0.02;
  expect_differences(bite, Theory::bland_ford, Arc::hitchcock);
}

TEST(SlabDerivatives, BlandFordWithFrictionThatFallsWithSpeed)
{
  RollBite bite                     = film_pass();
  bite.strip.friction               = {};
  bite.strip.friction.law           = FrictionLaw::speed;
  bite.strip.friction.at_unit_speed = 0.066723;
  bite.strip.friction.per_log_speed = -0.00662;
  bite.roll_speed                   = 100;
  expect_differences(bite, Theory::bland_ford, Arc::hitchcock);
}

TEST(SlabDerivatives, HuEhmannWithFrictionFactors)
{
  expect_differences(factor_pass(), Theory::hu_ehmann, Arc::rigid);
  RollBite bite   = factor_pass();
  bite.roll_speed = 3;
  bite.gap_rate   = 0.005;
  expect_differences(bite, Theory::hu_ehmann, Arc::hitchcock);
  bite.strip.flow_stress = {FlowStressLaw::swift, 1.3e9, 0.05, 0.15, 0, {}};
  expect_differences(bite, Theory::hu_ehmann, Arc::hitchcock);
}

// Exact against exact: the same equations run on complex numbers.
TEST(SlabDerivatives, AgreeWithAComplexStep)
{
  RollBite film = film_pass(), factor = factor_pass();
  film.gap_rate     = 0.02;
  factor.roll_speed = 3;
  factor.gap_rate   = 0.005;
  const auto exact  = within(1e-12, "both exact; rounding grows with the cancellation between the inputs");
  const double step = 1e-30;
  const BiteState a = solve_slab(film, {Theory::bland_ford, Arc::hitchcock});
  const BiteState b = solve_slab(factor, {Theory::hu_ehmann, Arc::hitchcock});
  for (int i = 0; i < n_inputs; ++i) {
    double speed = a.entry_speed;
    const auto by_film =
        bland_ford_state(film, complex_inputs(film, a.flattened_radius, Input(i), step), speed, hill_rules(film));
    EXPECT_TRUE(near(a.force_by[i], by_film.force.imag() / step, exact)) << i;
    EXPECT_TRUE(near(a.torque_by[i], by_film.torque.imag() / step, exact)) << i;
    speed                = b.entry_speed;
    const auto by_factor = hu_ehmann_state(factor, complex_inputs(factor, b.flattened_radius, Input(i), step),
                                           speed, hill_rules(factor), Integration::closed);
    EXPECT_TRUE(near(b.force_by[i], by_factor.force.imag() / step, exact)) << i;
    EXPECT_TRUE(near(b.torque_by[i], by_factor.torque.imag() / step, exact)) << i;
  }
}

// The slope with the arc following, against differences of complete solutions with the flattening inside.
TEST(SlabDerivatives, WithAFollowingArc)
{
  for (const RollBite &bite : {film_pass(), factor_pass()}) {
    const Theory theory   = slides(bite.strip.friction) ? Theory::bland_ford : Theory::hu_ehmann;
    const BiteState state = solve_slab(bite, {theory, Arc::hitchcock, 0});
    const double step     = 1e-6 * bite.strip.exit_thickness;
    double F[2];
    for (const int side : {0, 1}) {
      RollBite b = bite;
      b.strip.exit_thickness += side ? step : -step;
      F[side] = solve_slab(b, {theory, Arc::hitchcock, 0}).force;
    }
    EXPECT_TRUE(near(state.force_by_exit_following, (F[1] - F[0]) / (2 * step),
                     within(1e-6, "central difference of complete solutions")));
  }
}

// A power law that starts unhardened at the entry: the graded rule against brute force.
TEST(SlabDerivatives, AtTheSteepStartOfAPowerLaw)
{
  for (const auto law : {FlowStressLaw::swift, FlowStressLaw::ludwik, FlowStressLaw::power}) {
    RollBite bite          = demo_pass();
    bite.strip.flow_stress = {law, 28e6, 0.002, 0.2, 20e6, {}};
    double speed           = 0.6;
    const auto in          = pass_inputs<double>(bite, bite.roll_radius);
    const double forces    = bland_ford_state(bite, in, speed, even_rules(400)).force;
    EXPECT_TRUE(near(solve_slab(bite, {Theory::bland_ford, Arc::rigid}).force, forces,
                     within(4e-8, "400 even points, which converge with n^-2.4 and are the worse of both")));
  }
}
