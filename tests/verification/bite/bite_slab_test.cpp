// The closed pressure hill against the slab equation it comes from, integrated step by step here.
#include "core/base/errors.h"
#include "core/laws/flow_stress_law.h"
#include "reduce/bite/slab/slab_bite.h"
#include "tests/support/demo_pass.h"
#include "tests/support/near.h"
#include <cmath>
#include <functional>

using namespace mill;
using namespace mill::bite;

namespace {
BiteState solve_bite(const RollBite &bite, const Arc arc = Arc::rigid)
{
  return solve_slab(bite, {Theory::bland_ford, arc});
}

enum class Equation {
  bland_ford,  ///< h k d(p/k)/dx = p (dh/dx -+ 2 mu): the term (p/k - 1) d(hk)/dx left out
  karman       ///< h dp/dx = d(h k)/dx -+ 2 mu p
};

struct SlabSolution {
  double force;             ///< N/m of width
  double neutral_position;  ///< m
};

/// Runge-Kutta from both ends; the neutral point is where both branches meet.  The strain law is that of the case.
SlabSolution integrate(const RollBite &bite, const double R, const Equation equation)
{
  const Strip &s   = bite.strip;
  const double h0  = std::isnan(s.initial_thickness) ? s.entry_thickness : s.initial_thickness;
  const double x_e = std::sqrt(R * (s.entry_thickness - s.exit_thickness));
  const auto h     = [&](double x) { return s.exit_thickness + x * x / R; };
  const auto k     = [&](double x) { return flow_stress(s.flow_stress, std::log(h0 / h(x))); };
  const auto slope = [&](double x, double p, double side) {
    const double d  = 1e-5 * x_e;  // k is smooth, also just outside the arc; central difference error 1e-10
    const double dk = (k(x + d) - k(x - d)) / (2 * d);
    const double dh = 2 * x / R;
    if (equation == Equation::bland_ford)
      return p * (dh + side * 2 * s.friction.coefficient) / h(x) + p / k(x) * dk;
    return (dh * k(x) + h(x) * dk + side * 2 * s.friction.coefficient * p) / h(x);
  };
  // Pressure and force from one end to x_n; side +1 from the exit, -1 from the entry (friction reverses).
  const auto branch = [&](double from, double p, double to, double side) {
    const int n    = 1500;
    const double d = (to - from) / n;
    double force   = 0;
    for (int i = 0; i < n; ++i) {
      const double x  = from + i * d;
      const double k1 = slope(x, p, side), k2 = slope(x + d / 2, p + d / 2 * k1, side),
                   k3 = slope(x + d / 2, p + d / 2 * k2, side), k4 = slope(x + d, p + d * k3, side);
      const double next   = p + d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      const double middle = (p + next) / 2 + d / 8 * (k1 - slope(x + d, next, side));  // cubic Hermite
      force += std::abs(d) / 6 * (p + 4 * middle + next);                              // Simpson
      p = next;
    }
    return std::pair{p, force};
  };
  double low = 0, high = x_e;
  const double p_exit = k(0) - s.exit_tension, p_entry = k(x_e) - s.entry_tension;
  for (int i = 0; i < 50; ++i) {
    const double x                                                                   = (low + high) / 2;
    (branch(0, p_exit, x, 1).first < branch(x_e, p_entry, x, -1).first ? low : high) = x;
  }
  return {branch(0, p_exit, low, 1).second + branch(x_e, p_entry, low, -1).second, low};
}

RollBite cold_pass()
{
  RollBite bite                   = demo_pass();
  bite.roll_radius                = 0.5262338200786073;
  bite.strip.width                = 1.206;
  bite.strip.entry_thickness      = 0.789e-3;
  bite.strip.exit_thickness       = 0.577e-3;
  bite.strip.entry_tension        = 180e6;
  bite.strip.exit_tension         = 189e6;
  bite.strip.initial_thickness    = 3e-3;
  bite.strip.friction.coefficient = 0.02832038583977992;
  bite.strip.flow_stress.law      = FlowStressLaw::reduction_power;
  bite.strip.flow_stress.k        = 829.64259e6;
  bite.strip.flow_stress.eps0     = 0.00817;
  bite.strip.flow_stress.n        = 0.3;
  return bite;
}
}  // namespace

TEST(BiteSlab, ClosedFormSolvesItsOwnEquation)
{
  RollBite tension             = demo_pass();
  tension.strip.exit_tension   = 5e6;
  tension.strip.entry_tension  = 2e6;
  RollBite swift               = tension;
  swift.strip.flow_stress      = {};
  swift.strip.flow_stress.law  = FlowStressLaw::swift;
  swift.strip.flow_stress.k    = 60e6;
  swift.strip.flow_stress.eps0 = 0.05;
  swift.strip.flow_stress.n    = 0.15;
  for (const RollBite &bite : {demo_pass(), tension, swift, cold_pass()}) {
    const BiteState state       = solve_bite(bite);
    const SlabSolution stepwise = integrate(bite, bite.roll_radius, Equation::bland_ford);
    EXPECT_TRUE(near(state.force / bite.strip.width, stepwise.force,
                     within(1e-9, "Runge-Kutta of order four, 1500 steps; slope of k by differences")));
    EXPECT_TRUE(near(state.neutral_position, stepwise.neutral_position,
                     within(1e-8, "crossing of two nearly straight branches")));
  }
}

// What Bland and Ford leave out, on the same parabola: reference forces of the full slab equation, 984.35127 N/mm
// for the demo pass and 8508435.33 N for the cold pass (independent programs).
TEST(BiteSlab, DistanceToTheFullSlabEquation)
{
  const SlabSolution demo = integrate(demo_pass(), 0.210, Equation::karman);
  EXPECT_TRUE(near(demo.force, 984351.27, within(1e-7, "printed with eight digits")));
  EXPECT_TRUE(near(solve_bite(demo_pass()).force / demo.force, 0.9784, within(1e-4, "963.084 / 984.351")));
  const SlabSolution cold = integrate(cold_pass(), cold_pass().roll_radius, Equation::karman);
  EXPECT_TRUE(
      near(cold.force * 1.206, 8508435.325845541, within(1e-7, "independent integration of the same equation")));
  EXPECT_TRUE(near(cold.neutral_position, 0.002932440016814648, within(1e-6, "as the force")));
  EXPECT_TRUE(near(cold.force * 1.206 / solve_bite(cold_pass()).force - 1, -0.0261,
                   within(0.01, "printed -2.61 %: poor at these tensions")));
}

// R' must satisfy Hitchcock's formula with the force of a rigid roll of that radius, and no smaller radius may do
// so.
TEST(BiteSlab, FlattenedRadiusIsTheFirstRoot)
{
  RollBite bite                   = demo_pass();
  bite.roll_radius                = 0.250;
  bite.strip.entry_thickness      = 0.5e-3;
  bite.strip.exit_thickness       = 0.35e-3;
  bite.strip.entry_tension        = 100e6;
  bite.strip.exit_tension         = 150e6;
  bite.strip.friction.coefficient = 0.05;
  bite.strip.flow_stress.k        = 700e6;
  const auto map                  = [&](double R) {
    RollBite rigid    = bite;
    rigid.roll_radius = R;
    const double C0   = 16 * (1 - 0.28 * 0.28) / (M_PI * 2.1e11);
    return 0.250 * (1 + C0 * solve_bite(rigid).force / 0.15e-3);
  };
  const BiteState state = solve_bite(bite, Arc::hitchcock);
  EXPECT_TRUE(near(map(state.flattened_radius), state.flattened_radius, within(1e-12, "fixed point")));
  for (int i = 0; i < 200; ++i) {
    const double R = 0.250 + (state.flattened_radius - 0.250) * i / 200;
    EXPECT_GT(map(R), R);
  }
  EXPECT_GT(state.flattened_radius / 0.250, 1.5);
}

TEST(BiteSlab, TellsWhenNoFlattenedRadiusExists)
{
  RollBite bite    = cold_pass();
  bite.roll_radius = 0.300;
  bite.roll        = {2.1e11, 0.3, 7850};
  EXPECT_NO_THROW(solve_bite(bite, Arc::hitchcock));
  bite.strip.friction.coefficient = 0.14;  // film broken down
  try {
    solve_bite(bite, Arc::hitchcock);
    FAIL() << "a radius was returned";
  } catch (const SolverError &error) {
    EXPECT_NE(error.report.where.find("R'/R = "), std::string::npos);
    EXPECT_NE(error.report.remedy.find("friction"), std::string::npos);
  }
}
