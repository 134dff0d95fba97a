#include "core/base/errors.h"
#include "fem/strip/common/strip_material.h"
#include "fem/strip/elastic_plastic/strip_elastic.h"
#include "reduce/bite/arc/half_plane.h"
#include "tests/support/near.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;
using namespace mill::fem;

namespace {
using Inputs = std::array<double, n_row_inputs>;

FlowStress constant(const double k)
{
  FlowStress law;
  law.k = k;
  return law;
}
FlowStress swift()
{
  FlowStress law;
  law.law  = FlowStressLaw::swift;
  law.k    = 1.3;
  law.eps0 = 0.01;
  law.n    = 0.2;
  return law;
}

// The same velocity gradient at both points of an element that passes in unit time, from a stress and strain
// upstream.
Inputs even(const double xx, const double xy, const double yx, const double yy,
            const std::array<double, 4> &before = {})
{
  Inputs in{};
  for (const int point : {0, int(n_at_point)}) {
    in[point + gradient_xx] = xx;
    in[point + gradient_xy] = xy;
    in[point + gradient_yx] = yx;
    in[point + gradient_yy] = yy;
    in[point + transit]     = 1;
  }
  for (int s = 0; s < 4; ++s)
    in[upstream_xx + s] = before[s];
  in[stress_factor] = 1;
  return in;
}

// |s| of plane strain, s_zz = -(s_xx + s_yy)
double shear(const double xx, const double yy, const double xy)
{
  return std::sqrt(0.5 * (xx * xx + yy * yy + (xx + yy) * (xx + yy)) + xy * xy);
}
double shear(const RowSolution &r, const int point)
{
  return shear(r.state[n_row_state * point], r.state[n_row_state * point + 1], r.state[n_row_state * point + 2]);
}
}  // namespace

TEST(StripMaterial, IsHookesLawBelowYielding)
{
  const FlowStress law = constant(1);
  const double c       = 2e-3;  // 1/(2 G)
  const Inputs in      = even(1e-4, 2e-4, 2e-4, -3e-4, {0.05, -0.05, 0.01, 0});
  const RowSolution r  = solve_row({&law, 1, c, 0}, in, nullptr, false);
  ASSERT_TRUE(r.solved);
  const double third = (1e-4 - 3e-4) / 3;
  for (const int point : {0, 1}) {
    const double t = radau_point[point];
    const auto why = within(1e-12, "strain grows evenly, which two-stage Radau integrates exactly; no spin");
    EXPECT_TRUE(near(r.state[n_row_state * point + stress_xx], 0.05 + t * (1e-4 - third) / c, why));
    EXPECT_TRUE(near(r.state[n_row_state * point + stress_yy], -0.05 + t * (-3e-4 - third) / c, why));
    EXPECT_TRUE(near(r.state[n_row_state * point + stress_xy], 0.01 + t * 2e-4 / c, why));
    EXPECT_EQ(r.state[n_row_state * point + plastic_shear], 0);
    EXPECT_FALSE(r.plastic[point]);
  }
}

TEST(StripMaterial, WithoutElasticityIsTheRigidPlasticLaw)
{
  const FlowStress law = constant(1);
  const RowSolution r  = solve_row({&law, 1, 0, 0}, even(0.02, 0.01, 0.03, -0.02), nullptr, false);
  ASSERT_TRUE(r.solved);
  const double g = std::sqrt(2 * (2 * 0.02 * 0.02 + 2 * 0.02 * 0.02));  // rate of shear
  for (const int point : {0, 1}) {
    const auto why = within(1e-12, "s = 2 (k/2)/g D in closed form");
    EXPECT_TRUE(near(r.state[n_row_state * point + stress_xx], 0.02 / g, why));
    EXPECT_TRUE(near(r.state[n_row_state * point + stress_xy], 0.02 / g, why));
    EXPECT_TRUE(near(r.state[n_row_state * point + plastic_shear], g, why));
  }
  const RowSolution stiff = solve_row({&law, 1, 1e-9, 0}, even(0.02, 0.01, 0.03, -0.02), nullptr, false);
  EXPECT_LT((stiff.state - r.state).norm(), 1e-6) << "compliance times stress over strain = 1e-9/0.02";
}

TEST(StripMaterial, YieldsAtTheShearYieldStressAndHardensByThicknessStrain)
{
  const FlowStress law = swift();
  const StripMaterial m{&law, 1, 2e-3, 0};
  const Inputs in     = even(0.05, 0, 0, -0.05, {0, 0, 0, 0.03});
  const RowSolution r = solve_row(m, in, nullptr, false);
  ASSERT_TRUE(r.solved);
  const double g[2] = {r.state[plastic_shear], r.state[n_row_state + plastic_shear]};
  const auto why    = within(1e-11, "the yield condition itself, Newton's method stops at 1e-14");
  EXPECT_TRUE(near(shear(r, 0), 0.5 * 1.3 * std::pow(0.01 + 0.03 + g[0] / 6, 0.2), why));
  EXPECT_TRUE(near(shear(r, 1), 0.5 * 1.3 * std::pow(0.01 + 0.03 + (3 * g[0] + g[1]) / 8, 0.2), why));
  // Plane strain: thickness strain 0.05, less the elastic one, half the plastic shear
  EXPECT_TRUE(near((3 * g[0] + g[1]) / 8, 0.05 - 2e-3 * shear(r, 1),
                   within(1e-9, "total strain is elastic plus plastic, for a stress that keeps its direction")));
}

TEST(StripMaterial, SpinTurnsTheStressAndLeavesItsSize)
{
  const FlowStress law = constant(10);
  const double turn    = 0.05;  // rad in the element
  const RowSolution r =
      solve_row({&law, 1, 1e-3, 0}, even(0, -turn, turn, 0, {0.3, -0.3, 0.1, 0}), nullptr, false);
  ASSERT_TRUE(r.solved);
  const auto why = within(1e-5, "two-stage Radau has order 3: (2 x 0.05)^4/72 = 1.4e-6 of the stress");
  EXPECT_TRUE(near(r.state[n_row_state + stress_xx], 0.3 * std::cos(2 * turn) - 0.1 * std::sin(2 * turn), why));
  EXPECT_TRUE(near(r.state[n_row_state + stress_xy], 0.1 * std::cos(2 * turn) + 0.3 * std::sin(2 * turn),
                   within(3e-5, "the same over a smaller stress")));
}

// Work is dissipated or stored; the integration may lose some and must not create any (algebraic stability).
TEST(StripMaterial, NeverCreatesEnergy)
{
  const FlowStress law = constant(1);
  const double c       = 5e-3;
  for (int i = 0; i < 40; ++i) {
    const double a = 0.01 * std::sin(1.7 * i), b = 0.01 * std::cos(2.3 * i), d = 0.004 * std::sin(0.9 * i);
    Inputs in = even(a, b, b, -a, {0.3 * std::cos(0.7 * i), -0.2 * std::cos(0.7 * i), 0.3 * std::sin(i), 0});
    in[n_at_point + gradient_xx] = d;
    in[n_at_point + gradient_yy] = -d;
    const RowSolution r          = solve_row({&law, 1, c, 0}, in, nullptr, false);
    ASSERT_TRUE(r.solved);
    double work = 0, lost = 0;
    for (const int p : {0, 1}) {
      const double *s = r.state.data() + n_row_state * p, *D = in.data() + n_at_point * p;
      work += radau_weight[p] *
              (s[stress_xx] * D[gradient_xx] + s[stress_yy] * D[gradient_yy] + 2 * s[stress_xy] * D[gradient_xy]);
      lost += radau_weight[p] * s[plastic_shear] * shear(r, p);
    }
    const auto stored = [c](const double xx, const double yy, const double xy) {
      return c * std::pow(shear(xx, yy, xy), 2);
    };
    const double *end = r.state.data() + n_row_state;
    const double gain = stored(end[0], end[1], end[2]) - stored(in[upstream_xx], in[upstream_yy], in[upstream_xy]);
    EXPECT_GE(work - lost - gain, -1e-12) << "strain path " << i;
  }
}

TEST(StripMaterial, DerivativesAreThoseOfTheSolution)
{
  struct Kind {
    const char *name;
    FlowStress law;
    double compliance, cutoff_strain_rate, size;
  };
  for (const Kind &kind :
       {Kind{"elastic", constant(1), 2e-3, 0, 2e-4}, Kind{"plastic", constant(1), 2e-3, 0, 0.02},
        Kind{"hardening", swift(), 2e-3, 0, 0.02}, Kind{"regularised", swift(), 2e-3, 1e-3, 0.002},
        Kind{"rigid", swift(), 0, 1e-3, 0.02}}) {
    const StripMaterial m{&kind.law, 1, kind.compliance, kind.cutoff_strain_rate};
    Inputs in = even(kind.size, 0.3 * kind.size, 0.6 * kind.size, -0.9 * kind.size, {0.1, -0.08, 0.05, 0.02});
    in[n_at_point + gradient_xy] *= 1.5;
    in[n_at_point + transit] = 1.2;
    const RowSolution r      = solve_row(m, in, nullptr, true);
    ASSERT_TRUE(r.solved) << kind.name;
    for (int i = 0; i < n_row_inputs; ++i) {
      const double step = 1e-4 * (i < upstream_xx ? kind.size : 0.05);
      Inputs up = in, down = in;
      up[i] += step;
      down[i] -= step;
      const Eigen::VectorXd difference =
          (solve_row(m, up, nullptr, false).state - solve_row(m, down, nullptr, false).state) / (2 * step);
      const double error = (difference - r.by.col(i)).norm();
      EXPECT_LT(error, 1e-5 * (1 + r.by.col(i).norm()))
          << kind.name << ", input " << i << ": step^2 of the difference";
    }
  }
}

namespace {
bite::RollBite thin_pass()
{
  bite::RollBite b;
  b.roll_radius                = 0.25;
  b.strip.width                = 1;
  b.strip.entry_thickness      = 0.5e-3;
  b.strip.exit_thickness       = 0.35e-3;
  b.strip.entry_tension        = 100e6;
  b.strip.exit_tension         = 150e6;
  b.strip.flow_stress          = constant(700e6);
  b.strip.friction.coefficient = 0.05;
  return b;
}

template <class Call> std::string refusal(const Call &call)
{
  try {
    call();
  } catch (const InputError &e) {
    return e.problems.front().message;
  }
  return "";
}
}  // namespace

TEST(StripElastic, RefusesInWords)
{
  bite::RollBite b = thin_pass();
  StripElasticModel model;
  model.arc = bite::Arc::hitchcock;
  EXPECT_EQ(
      refusal([&] { solve_elastic_strip(b, model); }),
      "the elastic-plastic strip takes a rigid roll or an elastic one; Hitchcock's circle is for theories that "
      "cannot do with any shape");
  model.arc    = bite::Arc::rigid;
  b.gap_rate   = 1e-3;
  b.roll_speed = 10;
  EXPECT_EQ(refusal([&] { solve_elastic_strip(b, model); }),
            "the elastic-plastic strip is solved for a gap at rest, not for one that opens at 0.001 m/s");
  b                     = thin_pass();
  b.strip.poisson_ratio = 0.5;
  EXPECT_EQ(
      refusal([&] { solve_elastic_strip(b, model); }),
      "an elastic-plastic strip needs strip.youngs_modulus above 0 and strip.poisson_ratio between 0 and 0.5, not "
      "210 GPa and 0.5");
  b                      = thin_pass();
  b.strip.exit_thickness = 0.6e-3;
  EXPECT_NE(refusal([&] { solve_elastic_strip(b, model); }).find("strip.exit_thickness = 0.6 mm"),
            std::string::npos);
  b = thin_pass();
  const bite::ArcFlexibility surface =
      bite::half_plane_flexibility(Eigen::VectorXd::LinSpaced(9, -1e-3, 1e-3), b.roll, b.roll_radius);
  EXPECT_EQ(refusal([&] { solve_elastic_strip(b, model, &surface); }),
            "a flexibility of the roll's surface is for Arc::elastic only");
  model.arc = bite::Arc::elastic;
  EXPECT_NE(refusal([&] {
              solve_elastic_strip(b, model, &surface);
            }).find("the flexibility of the roll's surface is given from -1 to 1 mm"),
            std::string::npos);
}

// Lengths thrice, stresses seven times as large: forces 21 times.
TEST(StripElastic, ScalesAndStartsWarm)
{
  StripElasticModel model;
  model.elements_along     = 12;
  model.elements_through   = 2;
  const bite::RollBite b   = thin_pass();
  const StripElastic small = solve_elastic_strip(b, model);
  bite::RollBite large     = b;
  large.roll_radius *= 3;
  large.strip.entry_thickness *= 3;
  large.strip.exit_thickness *= 3;
  large.strip.flow_stress.k *= 7;
  large.strip.entry_tension *= 7;
  large.strip.exit_tension *= 7;
  large.strip.youngs_modulus *= 7;
  const StripElastic big = solve_elastic_strip(large, model);
  EXPECT_TRUE(near(big.flow.state.force, 21 * small.flow.state.force,
                   within(1e-8, "the same numbers after scaling; Newton's method stops at 1e-9")));
  EXPECT_TRUE(near(
      bite::by(small.flow.state.force_by, bite::Input::flow_stress) +
          b.strip.entry_tension * bite::by(small.flow.state.force_by, bite::Input::entry_tension) +
          b.strip.exit_tension * bite::by(small.flow.state.force_by, bite::Input::exit_tension),
      small.flow.state.force,
      within(0.05, "all stresses in proportion scale the force, but for elastic strain, which is not scaled")));
  bite::RollBite next = b;
  next.strip.exit_thickness *= 0.999;
  const StripElastic cold = solve_elastic_strip(next, model),
                     warm = solve_elastic_strip(next, model, nullptr, &small);
  EXPECT_LT(warm.flow.history.size(), cold.flow.history.size());
  EXPECT_TRUE(near(warm.flow.state.force, cold.flow.state.force,
                   within(2e-3, "the warm start keeps its mesh, the cold one makes its own")));
}

TEST(StripElastic, TakesAnyFlexibilityAndAnyLawOfFriction)
{
  StripElasticModel model;
  model.elements_along     = 12;
  model.elements_through   = 2;
  model.arc                = bite::Arc::elastic;
  bite::RollBite b         = thin_pass();
  b.roll_speed             = 10;
  const StripElastic plane = solve_elastic_strip(b, model);
  EXPECT_TRUE(plane.ends_fitted);
  // The same surface from a table, and a friction that happens to be the same at this speed
  const bite::ArcFlexibility surface =
      bite::half_plane_flexibility(Eigen::VectorXd::LinSpaced(301, -30e-3, 30e-3), b.roll, b.roll_radius);
  bite::RollBite slower               = b;
  slower.strip.friction.law           = FrictionLaw::speed;
  slower.strip.friction.scale         = 1;
  slower.strip.friction.at_unit_speed = 0.05 + 0.01 * std::log(10.);
  slower.strip.friction.per_log_speed = -0.01;
  const StripElastic table            = solve_elastic_strip(slower, model, &surface);
  EXPECT_TRUE(near(table.flow.state.force, plane.flow.state.force,
                   within(1e-7, "the difference from the half plane is zero and only interpolated; Newton 1e-9")));
  EXPECT_TRUE(near(bite::by(table.flow.state.force_by, bite::Input::roll_speed),
                   bite::by(table.flow.state.force_by, bite::Input::friction) * -0.01 / 10,
                   within(1e-12, "chain rule: d mu/d v = -0.01/v")));
  EXPECT_EQ(bite::by(plane.flow.state.force_by, bite::Input::roll_speed), 0) << "Coulomb's law knows no speed";
}

TEST(StripElastic, FactorsOfFrictionActWhereTheRollPresses)
{
  StripElasticModel model;
  model.elements_along          = 16;
  model.elements_through        = 2;
  bite::RollBite b              = thin_pass();
  b.strip.friction.law          = FrictionLaw::factor;
  b.strip.friction.entry_factor = b.strip.friction.exit_factor = 0.15;
  const StripElastic s                                         = solve_elastic_strip(b, model);
  const auto &state                                            = s.flow.state;
  for (int i = 0; i < state.position.size(); ++i)
    EXPECT_LE(std::abs(state.shear[i]), 0.15 * 0.5 * 700e6 * (1 + 1e-9)) << state.position[i];
  Eigen::Index peak;
  state.pressure.maxCoeff(&peak);
  EXPECT_TRUE(
      near(std::abs(state.shear[state.shear.size() - 8]), 0.15 * 0.5 * 700e6,
           within(0.03, "pressure over pressure plus a hundredth of the flow stress, at twice the flow stress: "
                        "0.5 %; slip next to its smearing: below 1 %")));
  EXPECT_EQ(s.flow.slip_changes, 1);
}
