#include "core/base/errors.h"
#include "core/laws/flow_stress_law.h"
#include "reduce/bite/slab/neutral_point.h"
#include "reduce/bite/slab/slab_bite.h"
#include "tests/support/demo_pass.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include <cmath>

using namespace mill;
using namespace mill::bite;

namespace {
RollBite constant_pass(const double R_mm, const double h1_mm, const double h2_mm, const double k_MPa,
                       const double mu)
{
  RollBite bite                   = demo_pass();
  bite.roll_radius                = R_mm * 1e-3;
  bite.strip.entry_thickness      = h1_mm * 1e-3;
  bite.strip.exit_thickness       = h2_mm * 1e-3;
  bite.strip.flow_stress.k        = k_MPa * 1e6;
  bite.strip.friction.coefficient = mu;
  return bite;
}

FlowStress law(const std::string &name)
{
  FlowStress f;
  f.law  = flow_stress_law(name);
  f.k    = 700e6;
  f.k0   = 300e6;
  f.eps0 = 0.01;
  f.n    = 0.2;
  return f;
}

BiteState solve_bite(const RollBite &bite, const Arc arc = Arc::rigid)
{
  return solve_slab(bite, {Theory::bland_ford, arc});
}

std::string message_of(const RollBite &bite)
{
  try {
    solve_bite(bite);
  } catch (const InputError &error) {
    return error.problems.at(0).message;
  }
  return "accepted";
}
}  // namespace

TEST(FlowStress, Laws)
{
  const double e     = 0.3;
  const auto formula = within(1e-14, "formula");
  EXPECT_TRUE(near(flow_stress(law("constant"), e), 700e6, formula));
  EXPECT_TRUE(near(flow_stress(law("swift"), e), 700e6 * std::pow(0.31, 0.2), formula));
  EXPECT_TRUE(near(flow_stress(law("ludwik"), e), 300e6 + 700e6 * std::pow(0.3, 0.2), formula));
  EXPECT_TRUE(near(flow_stress(law("voce"), e), 300e6 + 700e6 * (1 - std::exp(-0.06)), formula));
  EXPECT_TRUE(near(flow_stress(law("power"), e), 700e6 * std::pow(0.3, 0.2), formula));
  EXPECT_TRUE(
      near(flow_stress(law("reduction-power"), e), 700e6 * std::pow(0.01 + 1 - std::exp(-0.3), 0.2), formula));
  FlowStress table = law("table");
  table.table      = {{0, 300e6}, {0.2, 400e6}, {1, 480e6}};
  EXPECT_TRUE(near(flow_stress(table, 0.1), 350e6, formula));
  EXPECT_TRUE(near(flow_stress(table, 0.6), 440e6, formula));
  EXPECT_THROW(flow_stress(table, 1.1), InputError);
  EXPECT_THROW(flow_stress(law("hensel"), e), InputError);
  table.table = {{0, 300e6}};
  EXPECT_THROW(flow_stress(table, 0), InputError);
}

// Bland-Ford closed form, rigid roll, parabolic arc: N per mm of width from an independent program.
TEST(Bite, BlandFordForcesOfFivePasses)
{
  const double table[5][6] = {{210, 8, 5, 28, 0.2, 963.08384},
                              {420, 120, 100, 60, 0.35, 6114.60500},
                              {300, 40, 30, 80, 0.30, 5238.51951},
                              {100, 10, 9, 300, 0.10, 3068.63610},
                              {250, 2.0, 1.5, 600, 0.06, 7612.47475}};
  for (const auto &p : table)
    EXPECT_TRUE(near(solve_bite(constant_pass(p[0], p[1], p[2], p[3], p[4])).force, p[5] * 1e3,
                     within(1e-8, "printed with nine digits")));
}

// The un-approximated slab equation gives 984.351 N/mm on the same parabola and 989.456 on the circle with the
// friction share of the vertical force: Bland and Ford's step costs 2.2 %, the rest 0.5 %.
TEST(Bite, BlandFordLiesBelowTheSlabEquation)
{
  const double force         = solve_bite(demo_pass()).force * 1e-3;
  const Tolerance last_digit = within_absolute(5e-4, "half of the last digit of the share");
  EXPECT_TRUE(near(force / 984.35127, 0.978, last_digit));
  EXPECT_TRUE(near(force / 989.45598, 0.973, last_digit));
}

// Two conditions of a tandem mill (X. Liu et al., J. Vibroengineering 2017) at the friction their lubricant film
// gives; hardening law, tensions and flattening all act.  Reference from an independent program at full precision.
TEST(Bite, ColdPassesWithHardeningTensionAndFlattening)
{
  const double table[2][11] = {
      // h_e mm, h_d mm, sigma_e, sigma_d MPa, mu, F N, R' m, x_e m, x_n m, k_fe Pa, k_fd Pa
      {0.755, 0.568, 156, 197, 0.023968189622223662, 8257344.925615327, 0.5424180615984966, 0.010071354304110191,
       0.0032894652627086063, 763017137.5198973, 781358287.9541008},
      {0.789, 0.577, 180, 189, 0.02832038583977992, 8736293.890034175, 0.5262338200786073, 0.01056227105582245,
       0.003224610191225185, 759569726.7752361, 780498377.6549077}};
  for (const auto &c : table) {
    RollBite bite                = constant_pass(300, c[0], c[1], 829.64259, c[4]);
    bite.roll                    = {2.1e11, 0.3, 7850};
    bite.strip.width             = 1.206;
    bite.strip.entry_tension     = c[2] * 1e6;
    bite.strip.exit_tension      = c[3] * 1e6;
    bite.strip.initial_thickness = 3e-3;
    bite.strip.flow_stress.law   = FlowStressLaw::reduction_power;
    bite.strip.flow_stress.eps0  = 0.00817;
    bite.strip.flow_stress.n     = 0.3;
    const BiteState state        = solve_bite(bite, Arc::hitchcock);
    const auto fixed_point = within(1e-8, "fixed point converged to 1e-13, friction handed over with 16 digits");
    EXPECT_TRUE(near(state.force, c[5], fixed_point));
    EXPECT_TRUE(near(state.flattened_radius, c[6], fixed_point));
    EXPECT_TRUE(near(state.arc_length, c[7], fixed_point));
    EXPECT_TRUE(near(state.neutral_position, c[8], fixed_point));
    EXPECT_TRUE(near(state.entry_flow_stress, c[9], fixed_point));
    EXPECT_TRUE(near(state.exit_flow_stress, c[10], fixed_point));
    EXPECT_TRUE(near(state.forward_slip, (c[1] * 1e-3 + c[8] * c[8] / c[6]) / (c[1] * 1e-3) - 1,
                     within(1e-7, "volume flow at the neutral point")));
  }
}

// Thin strip between small rolls: 0.260 -> 0.180 mm, R 34.8 mm, tensions 38 and 35 kN on 505 mm.
TEST(Bite, ThinStripWithAndWithoutFlattening)
{
  RollBite bite            = constant_pass(34.8, 0.260, 0.180, 1200, 0.06);
  bite.roll                = {2.1e11, 0.3, 7850};
  bite.strip.width         = 0.505;
  bite.strip.entry_tension = 38e3 / (0.505 * 0.260e-3);
  bite.strip.exit_tension  = 35e3 / (0.505 * 0.180e-3);
  BiteState state          = solve_bite(bite);
  EXPECT_TRUE(near(state.force / 0.505, 1.696467431e6, within(1e-9, "printed with ten digits")));
  EXPECT_TRUE(
      near(state.neutral_position / state.arc_length, 0.330792812, within(2e-9, "printed with nine digits")));
  EXPECT_TRUE(near(state.peak_pressure, 1.227568157e9, within(1e-9, "printed with ten digits")));
  EXPECT_TRUE(near(solve_bite(bite, Arc::hitchcock).force, 1.188311e6, within(1e-6, "printed with seven digits")));
}

TEST(Bite, ForceScalesWithStressAndSize)
{
  const double force = solve_bite(demo_pass()).force;
  RollBite bite      = constant_pass(630, 24, 15, 7 * 28, 0.2);
  EXPECT_TRUE(near(solve_bite(bite).force, 21 * force, within(1e-12, "stress x 7, lengths x 3, width kept")));
}

TEST(Bite, TensionsLowerTheForceAndMoveTheNeutralPoint)
{
  const BiteState base     = solve_bite(demo_pass());
  RollBite bite            = demo_pass();
  bite.strip.exit_tension  = 3e6;
  const BiteState front    = solve_bite(bite);
  bite                     = demo_pass();
  bite.strip.entry_tension = 3e6;
  const BiteState back     = solve_bite(bite);
  EXPECT_LT(front.force, base.force);
  EXPECT_LT(back.force, front.force);  // back tension works on the longer side of the hill
  EXPECT_GT(front.forward_slip, base.forward_slip);
  EXPECT_LT(back.forward_slip, base.forward_slip);
}

TEST(Bite, PressureHillIsContinuousWithItsPeakAtTheNeutralPoint)
{
  RollBite bite           = demo_pass();
  bite.strip.exit_tension = 2e6;
  const BiteState state   = solve_bite(bite);
  Eigen::Index peak;
  state.pressure.maxCoeff(&peak);
  EXPECT_TRUE(near(state.position[peak], state.neutral_position,
                   within(1e-14, "the neutral point is one of the samples")));
  EXPECT_TRUE(near(state.pressure[0], 26e6, within(1e-12, "flow stress minus front tension")));
  EXPECT_TRUE(near(state.pressure[200], 28e6, within(1e-12, "flow stress, no back tension")));
  EXPECT_TRUE(near(state.thickness[200], 8e-3, within(1e-14, "entry thickness")));
  double force = 0;  // trapezium over the samples
  for (Eigen::Index i = 1; i < state.position.size(); ++i)
    force += (state.position[i] - state.position[i - 1]) * (state.pressure[i] + state.pressure[i - 1]) / 2;
  EXPECT_TRUE(near(force, state.force, within(1e-4, "trapezium rule on 200 intervals")));
}

// One rule below least_strain for every law that grows from nothing: value and slope join, nothing is negative or
// without bound, and above it the law is what it says.
TEST(FlowStress, SmallStrains)
{
  for (const char *name : {"swift", "ludwik", "voce", "power", "reduction-power"})
    for (const double n : {0.1, 0.5, 1., 3.}) {
      FlowStress l      = law(name);
      l.eps0            = 0;
      l.k0              = 0;
      l.n               = n;
      const auto slope  = [&](const double e) { return flow_stress(l, Dual<1>::variable(e, 0)).by[0]; };
      const double join = strain_of_growth(l), step = 1e-12;
      const double at_join = flow_stress(l, join);
      EXPECT_TRUE(near(flow_stress(l, join - step), at_join, within(1e-7, "no jump"))) << name << n;
      EXPECT_TRUE(near(slope(join - step), slope(join + step), within(1e-6, "no kink"))) << name << n;
      for (const double e : {-1e-3, -1e-17, 0., 5e-5}) {
        if (n != 1 || std::string(name) == "voce") {  // a straight line is taken as it is
          EXPECT_GT(flow_stress(l, e), 0) << name << n << " at " << e;
        }
        EXPECT_TRUE(std::isfinite(slope(e)) && slope(e) >= 0) << name << n << " at " << e;
      }
      if (n != 1)
        EXPECT_TRUE(starts_from_nothing(l, 0)) << name;
    }
  FlowStress hardened = law("swift");  // eps0 of a hundredth: no small strain from the entry on
  EXPECT_TRUE(near(flow_stress(hardened, 0.), 700e6 * std::pow(0.01, 0.2), within(1e-15, "the law as it is")));
  EXPECT_FALSE(starts_from_nothing(hardened, 0));
}

TEST(FlowStress, CarriedBeyondATable)
{
  FlowStress table = law("table");
  table.table      = {{0.1, 300e6}, {0.2, 400e6}};
  EXPECT_EQ(carried_flow_stress(table, 0.05), 300e6);
  EXPECT_EQ(carried_flow_stress(table, 0.9), 400e6);
  EXPECT_TRUE(near(carried_flow_stress(table, 0.15), 350e6, within(1e-14, "straight line")));
}

// asin(x_n/R): 3-4-5 triangle; R' does not enter.
TEST(Bite, NeutralAngleIsAnAngleAtTheAxisOfTheRoll)
{
  RollBite bite    = demo_pass();
  bite.roll_radius = 0.5;
  BiteState state;
  state.neutral_position = 0.3;
  state.flattened_radius = 0.9;
  EXPECT_TRUE(near(neutral_angle(bite, state), std::atan2(3, 4), within(1e-15, "sides 3, 4, 5")));
}

// h_d (1 + (k - s_d)(1 - nu^2)/E): where (17.12) has no pressure left.
TEST(Bite, StripSpringsBackBehindAFreeArc)
{
  RollBite bite             = demo_pass();
  bite.strip.exit_tension   = 8e6;
  bite.strip.youngs_modulus = 200e9;
  bite.strip.poisson_ratio  = 0.3;
  BiteState state;
  state.exit_flow_stress = 28e6;
  EXPECT_TRUE(near(leaving_thickness(bite, state, Arc::elastic) / 5e-3 - 1, 20e6 * 0.91 / 200e9,
                   within(1e-9, "closed form, less one")));
  EXPECT_EQ(leaving_thickness(bite, state, Arc::hitchcock), 5e-3);
}

// A linear table and Ludwik's law with n = 1 are one law; so is a table cut into pieces.
TEST(Bite, TableIsIntegratedAcrossItsKinks)
{
  RollBite ludwik               = demo_pass();
  ludwik.strip.flow_stress.law  = FlowStressLaw::ludwik;
  ludwik.strip.flow_stress.k0   = 28e6;
  ludwik.strip.flow_stress.k    = 20e6;
  ludwik.strip.flow_stress.n    = 1;
  RollBite table                = ludwik;
  table.strip.flow_stress.law   = FlowStressLaw::table;
  table.strip.flow_stress.table = {{0, 28e6}, {0.1, 30e6}, {0.31, 34.2e6}, {1, 48e6}};
  EXPECT_TRUE(near(solve_bite(table).force, solve_bite(ludwik).force, within(1e-13, "same law")));
  EXPECT_TRUE(near(slab_stiffness(table, solve_bite(table)).plastic_slope,
                   slab_stiffness(ludwik, solve_bite(ludwik)).plastic_slope, within(1e-12, "same law")));
  // A real kink: halving the pieces on either side of it must not change anything.
  table.strip.flow_stress.table = {{0, 28e6}, {0.2, 60e6}, {1, 62e6}};
  RollBite finer                = table;
  finer.strip.flow_stress.table = {{0, 28e6}, {0.1, 44e6}, {0.2, 60e6}, {0.3, 60.25e6}, {1, 62e6}};
  EXPECT_TRUE(near(solve_bite(table).force, solve_bite(finer).force, within(1e-13, "same polygon")));
}

TEST(BiteStiffness, DemoPass)
{
  const RollBite bite   = demo_pass();
  const BiteStiffness k = slab_stiffness(bite, solve_bite(bite));
  const double K_flat   = reference("flattening_K4")[1];
  EXPECT_TRUE(near(k.plastic_slope, 226.424e6, within(3e-6, "printed with six digits")));
  EXPECT_TRUE(near(k.flattening, K_flat, within(1e-12, "closed form")));
  EXPECT_TRUE(near(k.combined, 1 / (1 / 226.424e6 + 2 / K_flat), within(3e-6, "printed with six digits")));
  EXPECT_EQ(k.plastic_slope, k.plastic_slope_following);  // rigid roll: nothing follows
}

TEST(BiteStiffness, FlatteningOfThreeWidths)
{
  const auto expected   = reference("flattening_K4");
  const double width[3] = {0.3, 1.0, 1.4};
  for (int i = 0; i < 3; ++i) {
    RollBite bite    = demo_pass();
    bite.strip.width = width[i];
    EXPECT_TRUE(
        near(slab_stiffness(bite, solve_bite(bite)).flattening, expected[i], within(1e-12, "closed form")));
  }
}

// (8.12) on the arc of the loaded roll: the closed form again, with l = sqrt(R' dh).
TEST(BiteStiffness, FlatteningTakesTheFlattenedArc)
{
  const RollBite bite   = constant_pass(250, 2.0, 1.5, 600, 0.06);
  const BiteState state = solve_bite(bite, Arc::hitchcock);
  ASSERT_GT(state.flattened_radius, 1.3 * bite.roll_radius);
  const double A = 2 * (1 - bite.roll.poisson_ratio * bite.roll.poisson_ratio) / (M_PI * bite.roll.youngs_modulus);
  const double l = std::sqrt(state.flattened_radius * 0.5e-3);
  EXPECT_TRUE(near(slab_stiffness(bite, state).flattening,
                   bite.strip.width / (A * (std::log(8 * bite.roll_radius / l) - 0.5)),
                   within(1e-12, "closed form")));
  BiteState contact     = state;  // of a free arc
  contact.arc_length    = 1.2 * l;
  contact.exit_position = -0.3 * l;
  EXPECT_TRUE(near(slab_stiffness(bite, contact).flattening,
                   bite.strip.width / (A * (std::log(8 * bite.roll_radius / (1.5 * l)) - 0.5)),
                   within(1e-12, "closed form")));
}

// The exact derivative against differences of complete solutions, rigid, with R' held and with R' following.
TEST(BiteStiffness, IsTheSlopeOfTheForce)
{
  for (const char *name : {"constant", "swift", "voce"})
    for (const Arc arc : {Arc::rigid, Arc::hitchcock}) {
      RollBite bite           = constant_pass(250, 2.0, 1.5, 600, 0.06);
      bite.strip.flow_stress  = law(name);
      bite.strip.exit_tension = 80e6;
      const BiteState state   = solve_bite(bite, arc);
      const BiteStiffness k   = slab_stiffness(bite, state);
      const double step       = 1e-5 * bite.strip.exit_thickness;
      const auto force_at     = [&](double h, bool following) {
        RollBite moved             = bite;
        moved.strip.exit_thickness = h;
        if (following)
          return solve_bite(moved, arc).force;
        moved.roll_radius = state.flattened_radius;
        return solve_bite(moved).force;
      };
      const double h        = bite.strip.exit_thickness;
      const auto difference = within(1e-6, "central difference: truncation 1e-9, rounding 1e-10");
      EXPECT_TRUE(
          near(k.plastic_slope, (force_at(h - step, false) - force_at(h + step, false)) / (2 * step), difference))
          << name;
      EXPECT_TRUE(near(k.plastic_slope_following,
                       (force_at(h - step, true) - force_at(h + step, true)) / (2 * step), difference))
          << name;
      // R' ~ F/dh falls with a wider gap only if the force falls faster than the reduction.
      if (arc == Arc::hitchcock)
        EXPECT_EQ(k.plastic_slope_following > k.plastic_slope,
                  k.plastic_slope > state.force / (bite.strip.entry_thickness - h))
            << name;
    }
}

// Least friction of the first message: ln(8/5) / (2 sqrt(210/5) atan(sqrt(3/5))) = 0.0550206.
TEST(BiteErrors, ReportInvalidInput)
{
  RollBite bite                   = demo_pass();
  bite.strip.friction.coefficient = 0.02;
  EXPECT_EQ(
      message_of(bite),
      "strip.friction = 0.02 is too small for an angle of bite of 0.1195 rad: the rolls cannot pull the strip "
      "through, the neutral point would lie beyond the exit; more than 0.05502 is needed, or a smaller reduction, "
      "more front tension or less back tension");
  bite                    = demo_pass();
  bite.strip.exit_tension = 1.1 * 28e6;
  EXPECT_EQ(message_of(bite), "strip.exit_tension = 30.8 MPa reaches the flow stress 28 MPa at the exit: the "
                              "strip yields behind the bite");
  bite                     = demo_pass();
  bite.strip.entry_tension = 28e6;
  EXPECT_EQ(message_of(bite), "strip.entry_tension = 28 MPa reaches the flow stress 28 MPa at the entry: the "
                              "strip yields before the bite");
  bite                      = demo_pass();
  bite.strip.exit_thickness = 8e-3;
  EXPECT_EQ(message_of(bite),
            "strip.exit_thickness = 8 mm must be positive and below strip.entry_thickness = 8 mm");
  bite                         = demo_pass();
  bite.strip.initial_thickness = 7e-3;
  EXPECT_EQ(message_of(bite), "strip.initial_thickness = 7 mm is below strip.entry_thickness = 8 mm: the strip "
                              "would have been rolled thicker");
  bite                            = demo_pass();
  bite.strip.friction.coefficient = 0.005;
  bite.strip.exit_tension         = 27e6;
  EXPECT_NE(message_of(bite).find("the strip is torn through"), std::string::npos);
  bite             = demo_pass();
  bite.strip.width = 0;
  EXPECT_EQ(message_of(bite), "strip.width and the work roll diameter must be positive");
  bite                            = demo_pass();
  bite.strip.friction.coefficient = 0;
  EXPECT_EQ(message_of(bite),
            "strip.friction must be positive: without friction the rolls do not pull the strip through");
  bite                       = demo_pass();
  bite.strip.flow_stress.law = FlowStressLaw::power;  // what an unhardened strip of a pure power law yields at is
                                                      // open: no tension to divide by it
  bite.strip.flow_stress.n = 0.2;
  EXPECT_EQ(message_of(bite), "accepted");
  bite.strip.entry_tension = 1e6;
  EXPECT_EQ(
      message_of(bite),
      "strip.entry_tension = 1 MPa: the theory of Bland and Ford divides it by the flow stress at the entry, "
      "which strip.flow_stress.law = \"power\" leaves open for a strip without strain; take karman, or give "
      "strip.initial_thickness");
}

TEST(BiteErrors, FrictionAtTheStatedLimitIsEnough)
{
  RollBite bite                   = demo_pass();
  bite.strip.friction.coefficient = 0.05503;
  EXPECT_EQ(message_of(bite), "accepted");
  bite.strip.friction.coefficient = 0.05501;
  EXPECT_NE(message_of(bite), "accepted");
}

TEST(BiteNotes, WarnOutsideTheRangeOfTheModel)
{
  EXPECT_TRUE(solve_bite(demo_pass()).notes.empty());
  RollBite bite                   = demo_pass();
  bite.strip.friction.coefficient = 0.1;  // below the angle of bite 0.12
  ASSERT_EQ(solve_bite(bite).notes.size(), 1u);
  EXPECT_EQ(solve_bite(bite).notes[0].id, WarningId::bite_angle);
  bite.strip.friction.coefficient = 0.5;  // 2 mu p / k above one
  EXPECT_GT(solve_bite(bite).largest_shear, 1);
  ASSERT_EQ(solve_bite(bite).notes.size(), 1u);
  EXPECT_EQ(solve_bite(bite).notes[0].id, WarningId::bite_sticking);
}
