#include "core/base/errors.h"
#include "reduce/bite/slab/karman.h"
#include "reduce/bite/slab/karman_arc.h"
#include "reduce/bite/slab/sims.h"
#include "tests/support/demo_pass.h"
#include "tests/support/friction_laws.h"
#include "tests/support/near.h"
#include <cmath>
#include <functional>

using namespace mill;
using namespace mill::bite;

namespace {
KarmanOptions no_curves()
{
  KarmanOptions options;
  options.points = 0;
  return options;
}

BiteState solve(const RollBite &bite, const Theory theory = Theory::karman, const Arc arc = Arc::rigid)
{
  return solve_karman(bite, theory, arc, nullptr, no_curves());
}

/// Cold pass with tensions: 2 -> 1.5 mm.
RollBite cold_pass()
{
  RollBite bite                   = demo_pass();
  bite.roll_radius                = 0.25;
  bite.strip.entry_thickness      = 2e-3;
  bite.strip.exit_thickness       = 1.5e-3;
  bite.strip.entry_tension        = 50e6;
  bite.strip.exit_tension         = 80e6;
  bite.strip.flow_stress          = {FlowStressLaw::swift, 760e6, 0.01, 0.2, 0, {}};
  bite.strip.friction.coefficient = 0.06;
  return bite;
}

double central(const std::function<double(double)> &f, const double step)
{
  return (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step);
}

double slope_by_exit(const RollBite &bite, const Theory theory, const Arc arc, const double step)
{
  return central(
      [&](const double x) {
        RollBite moved = bite;
        moved.strip.exit_thickness += x;
        return solve(moved, theory, arc).force;
      },
      step);
}

std::string refusal(const std::function<void()> &call)
{
  try {
    call();
  } catch (const InputError &e) {
    return e.problems.at(0).message;
  }
  return "accepted";
}
}  // namespace

TEST(Karman, ScalesWithStressAndLength)
{
  for (const Theory theory : {Theory::karman, Theory::orowan}) {
    const BiteState one = solve(demo_pass(), theory);
    RollBite large      = demo_pass();
    large.roll_radius *= 3;
    large.strip.entry_thickness *= 3;
    large.strip.exit_thickness *= 3;
    large.strip.flow_stress.k *= 7;
    const BiteState other = solve(large, theory);
    EXPECT_TRUE(near(other.force, 21 * one.force, within(1e-10, "same numbers up to rounding and step choice")));
    EXPECT_TRUE(near(other.torque, 63 * one.torque, within(1e-10, "same numbers up to rounding and step choice")));
    EXPECT_TRUE(
        near(other.forward_slip, one.forward_slip, within(1e-9, "difference of nearly equal thicknesses")));
  }
}

TEST(Karman, MuchFrictionUnderALimitIsSticking)
{
  for (const Theory theory : {Theory::karman, Theory::orowan}) {
    RollBite coulomb                   = demo_pass();
    coulomb.strip.friction.coefficient = 5;
    RollBite factor                    = demo_pass();
    factor.strip.friction              = {};
    factor.strip.friction.law          = FrictionLaw::factor;
    factor.strip.friction.entry_factor = factor.strip.friction.exit_factor = 1;
    const BiteState a = solve(coulomb, theory), b = solve(factor, theory);
    EXPECT_TRUE(near(a.force, b.force, within(1e-10, "the limit holds all along")));
    EXPECT_TRUE(near(a.sticking_length, a.arc_length, within(1e-12, "the limit holds all along")));
    EXPECT_EQ(by(a.force_by, Input::friction), 0) << "more friction changes nothing";
  }
}

TEST(Karman, LimitOfTheFrictionInAPartOfTheArc)
{
  RollBite bite                   = demo_pass();
  bite.strip.friction.coefficient = 0.3;
  RollBite free                   = bite;
  free.strip.friction.shear_limit = not_given;
  for (const Theory theory : {Theory::karman, Theory::orowan}) {
    const BiteState capped = solve(bite, theory);
    EXPECT_GT(capped.sticking_length, 0.05 * capped.arc_length);
    EXPECT_LT(capped.sticking_length, 0.95 * capped.arc_length);
    EXPECT_GT(capped.largest_shear, 1);
    EXPECT_TRUE(near(by(capped.force_by, Input::flow_stress), capped.force, within(1e-10, "F scales with k")));
    EXPECT_TRUE(near(by(capped.force_by, Input::exit_thickness), slope_by_exit(bite, theory, Arc::rigid, 3e-6),
                     within(1e-6, "differences; the ends of the sticking zone move")));
    ASSERT_EQ(capped.remarks.size(), 1u);
    EXPECT_NE(capped.remarks[0].find("the friction stress is at its limit over "), std::string::npos);
  }
  const BiteState uncapped = solve(free);
  EXPECT_GT(uncapped.force, solve(bite).force);
  ASSERT_EQ(uncapped.notes.size(), 1u);
  EXPECT_EQ(uncapped.notes[0].id, WarningId::bite_sticking);
  EXPECT_EQ(uncapped.notes[0].detail, "the strip would stick, but no limit is set");
}

TEST(Karman, EveryFlowStressLaw)
{
  const std::vector<FlowStress> laws = {
      {FlowStressLaw::constant, 600e6, 0, 0, 0, {}},
      {FlowStressLaw::swift, 760e6, 0.01, 0.2, 0, {}},
      {FlowStressLaw::ludwik, 400e6, 0, 0.5, 400e6, {}},
      {FlowStressLaw::voce, 250e6, 0, 6, 450e6, {}},
      {FlowStressLaw::power, 900e6, 0, 0.3, 0, {}},
      {FlowStressLaw::reduction_power, 850e6, 0.008, 0.3, 0, {}},
      {FlowStressLaw::table, 0, 0, 0, 0, {{0, 400e6}, {0.1, 600e6}, {0.15, 640e6}, {0.4, 700e6}}}};
  for (const FlowStress &law : laws)
    for (const Theory theory : {Theory::karman, Theory::orowan})
      for (const Arc arc : {Arc::rigid, Arc::hitchcock}) {
        RollBite bite          = cold_pass();
        bite.strip.flow_stress = law;
        if (law.law == FlowStressLaw::power)
          bite.strip.entry_tension = 0;  // it has no flow stress at the entry
        const BiteState s = solve(bite, theory, arc);
        EXPECT_GT(s.force, 1e6) << name_of(law.law);
        EXPECT_TRUE(near(s.force_by_exit_following, slope_by_exit(bite, theory, arc, 2e-7),
                         within(1e-6, "differences: truncation, and kinks of the table in the arc")))
            << name_of(law.law);
      }
}

TEST(Karman, TableOfOneLevelIsTheConstant)
{
  RollBite bite          = demo_pass();
  const double constant  = solve(bite).force;
  bite.strip.flow_stress = {FlowStressLaw::table, 0, 0, 0, 0, {{0, 28e6}, {0.2, 28e6}, {1, 28e6}}};
  EXPECT_TRUE(near(solve(bite).force, constant, within(1e-11, "same law")));
}

TEST(Karman, EveryFrictionLaw)
{
  RollBite bite   = cold_pass();
  bite.roll_speed = 10;
  for (const Friction &law : laws_of_friction())
    for (const Theory theory : {Theory::karman, Theory::orowan}) {
      bite.strip.friction = law;
      const BiteState s   = solve(bite, theory, Arc::hitchcock);
      EXPECT_GT(s.neutral_position, 0);
      EXPECT_LT(s.neutral_position, s.arc_length);
      EXPECT_TRUE(near(s.exit_speed * bite.strip.exit_thickness, s.entry_speed * bite.strip.entry_thickness,
                       within(1e-14, "volume")));
      EXPECT_TRUE(near(s.force_by_exit_following, slope_by_exit(bite, theory, Arc::hitchcock, 2e-7),
                       within(1e-6, "differences, the film following")))
          << name_of(law.law);
      if (!slides(law))
        continue;
      const double by_speed = central(
          [&](const double v) {
            RollBite faster = bite;
            faster.roll_speed += v;
            return solve_on_circle(faster, theory, s.flattened_radius, solve(faster, theory, Arc::rigid).friction,
                                   no_curves())
                .force.value;
          },
          1e-2);
      if (law.law == FrictionLaw::speed)
        EXPECT_TRUE(near(by(s.force_by, Input::roll_speed), by_speed, within(1e-6, "differences")));
      else
        EXPECT_LT(by(s.force_by, Input::roll_speed), 0) << "a faster roll draws in more oil";
    }
  bite.strip.friction = laws_of_friction()[1];
  const BiteState s   = solve(bite);
  EXPECT_TRUE(
      near(s.friction, 0.012 + 0.142 * std::exp(-2.43e6 * s.film_thickness), within(1e-12, "the law itself")));
}

TEST(Karman, DerivativeByRollSpeedUnderAFilm)
{
  RollBite bite           = cold_pass();
  bite.roll_speed         = 10;
  Friction &film          = bite.strip.friction;
  film.law                = FrictionLaw::film;
  film.mu0                = 0.012;
  film.mu1                = 0.142;
  film.decay              = 2.43e6;
  film.viscosity          = 0.005;
  film.pressure_viscosity = 2e-8;
  const BiteState s       = solve(bite);
  const auto moved        = [&](const std::function<double(const BiteState &)> &what) {
    return central(
        [&](const double v) {
          RollBite faster = bite;
          faster.roll_speed += v;
          return what(solve(faster));
        },
        1e-2);
  };
  EXPECT_TRUE(near(by(s.force_by, Input::roll_speed), moved([](const BiteState &x) { return x.force; }),
                   within(1e-7, "differences")));
  EXPECT_TRUE(near(by(s.torque_by, Input::roll_speed), moved([](const BiteState &x) { return x.torque; }),
                   within(1e-6, "differences of a difference of two shear integrals")));
}

TEST(Karman, TorqueDerivativesWithAMovingNeutralPoint)
{
  for (const Theory theory : {Theory::karman, Theory::orowan}) {
    const RollBite bite = cold_pass();
    const BiteState s   = solve(bite, theory);
    const double step   = 1e-6;
    const auto torque   = [&](const double x) {
      RollBite moved = bite;
      moved.strip.exit_thickness += x;
      return solve(moved, theory).torque;
    };
    EXPECT_TRUE(near(by(s.torque_by, Input::exit_thickness), central(torque, step), within(1e-7, "differences")));
    const auto tension = [&](const double x) {
      RollBite moved = bite;
      moved.strip.exit_tension += x;
      return solve(moved, theory).torque;
    };
    EXPECT_TRUE(near(by(s.torque_by, Input::exit_tension), central(tension, 1e5), within(1e-7, "differences")));
  }
}

TEST(Karman, PowerOfTheRollsIsPlasticWorkAndFriction)
{
  // Small angles and no friction stress in the balance of slices: the front tension that replaces the torque.
  RollBite bite     = demo_pass();
  const BiteState s = solve_karman(bite, Theory::karman, Arc::rigid, nullptr);
  // Horizontal balance of the whole bite: 2 int (p sin - tau cos) R dphi = s2 h2 - s1 h1 = 0.
  double balance = 0, size = 0;
  for (Eigen::Index i = 0; i + 1 < s.position.size(); ++i) {
    const auto value_at = [&](const Eigen::Index j, const double shear) {
      const double sine = s.position[j] / bite.roll_radius;
      return s.pressure[j] * sine / std::sqrt(1 - sine * sine) - shear;
    };
    const double dx = s.position[i + 1] - s.position[i];
    // At the neutral point the shear jumps; the curve has zero there.
    const double a = s.shear[i] == 0 ? s.shear[i + 1] : s.shear[i],
                 b = s.shear[i + 1] == 0 ? s.shear[i] : s.shear[i + 1];
    balance += 0.5 * dx * (value_at(i, a) + value_at(i + 1, b));
    size += 0.5 * dx * (s.shear[i + 1] * s.shear[i + 1] > 0 ? std::abs(b) : 0);
  }
  EXPECT_LT(std::abs(balance), 1e-3 * size)
      << "trapezoidal rule of 200 points, with the jump at the neutral point";
}

TEST(Karman, CurvesAlongTheArc)
{
  for (const Theory theory : {Theory::karman, Theory::orowan}) {
    const BiteState s = solve_karman(cold_pass(), theory, Arc::rigid, nullptr);
    EXPECT_TRUE(near(static_cast<double>(s.position.size()), 200,
                     within_absolute(1, "one point more or less at the neutral point")))
        << "points asked for";
    EXPECT_TRUE(near(s.position[0], 0, within(1e-12, "exit on the line of centres", s.arc_length)));
    EXPECT_TRUE(near(s.position[s.position.size() - 1], s.arc_length, within(1e-12, "entry")));
    double force = 0;
    bool neutral = false;
    for (Eigen::Index i = 0; i < s.position.size(); ++i) {
      neutral = neutral || (std::abs(s.position[i] - s.neutral_position) < 1e-12 && std::abs(s.slip[i]) < 1e-12 &&
                            s.shear[i] == 0);
      if (i > 0) {
        EXPECT_GT(s.position[i], s.position[i - 1]);
        force += 0.5 * (s.pressure[i] + s.pressure[i - 1]) * (s.position[i] - s.position[i - 1]);
      }
    }
    EXPECT_TRUE(neutral) << "the neutral point is among the points";
    EXPECT_TRUE(near(force, s.force / cold_pass().strip.width,
                     within(2e-3, "trapezoidal rule, without the friction's share")));
    if (theory == Theory::karman)
      EXPECT_TRUE(near(s.pressure[0], s.exit_flow_stress - 80e6, within(1e-12, "yield at the exit")));
    EXPECT_LT(s.shear[1], 0) << "the roll holds the strip back behind the neutral point";
    EXPECT_GT(s.shear[s.shear.size() - 2], 0);
    EXPECT_TRUE(near(s.slip[0], s.forward_slip, within(1e-12, "exit speed")));
  }
}

TEST(Karman, RefusalsWordForWord)
{
  RollBite bite                   = demo_pass();
  bite.strip.friction.coefficient = 0.02;
  EXPECT_EQ(refusal([&] { solve(bite); }), "strip.friction = 0.02 is too small for an angle of bite of 0.1196 "
                                           "rad: the rolls cannot pull the strip through, "
                                           "the neutral point would lie beyond the exit; more than 0.06014 is "
                                           "needed, or a smaller reduction, more front "
                                           "tension or less back tension");
  bite.strip.friction.coefficient = 0.06015;
  EXPECT_LT(solve(bite).neutral_position, 1e-4) << "with what is said to be needed it rolls, only just";
  bite                    = demo_pass();
  bite.strip.exit_tension = 1.1 * 28e6;
  EXPECT_EQ(refusal([&] { solve(bite); }), "strip.exit_tension = 30.8 MPa reaches the flow stress 28 MPa at the "
                                           "exit: the strip yields behind the bite");
  bite                      = demo_pass();
  bite.strip.exit_thickness = 9e-3;
  EXPECT_EQ(refusal([&] { solve(bite); }),
            "strip.exit_thickness = 9 mm must be positive and below strip.entry_thickness = 8 mm");
  bite            = demo_pass();
  bite.roll_speed = 2;
  bite.gap_rate   = 0.01;
  EXPECT_EQ(refusal([&] { solve(bite); }), "the gap opens at 0.01 m/s: the integrated slab theories take it as "
                                           "resting; bland_ford and hu_ehmann know a "
                                           "moving gap");
  bite                            = demo_pass();
  bite.strip.friction.shear_limit = 1.2;
  EXPECT_EQ(refusal([&] { solve(bite); }),
            "strip.friction.shear_limit = 1.2 must be above 0 and at most 1, the shear yield stress of the strip");
  EXPECT_EQ(refusal([&] { solve(demo_pass(), Theory::sims); }),
            "Sims' formula takes the strip as sticking; with a friction coefficient of 0.2 it slips. It is "
            "refused below "
            "0.25; use karman or orowan");
  bite                            = demo_pass();
  bite.strip.friction.coefficient = 0.3;
  bite.strip.exit_tension         = 5e6;
  EXPECT_EQ(refusal([&] { solve(bite, Theory::sims); }), "Sims' formula knows no tension, but strip.entry_tension "
                                                         "= 0 MPa and strip.exit_tension = 5 MPa; use karman or "
                                                         "orowan");
  EXPECT_EQ(
      refusal([&] { solve(demo_pass(), Theory::orowan, Arc::elastic); }),
      "the elastic arc is known to the theory karman only: the pressure along an arc that is not a circle is "
      "integrated "
      "with it");
}

TEST(Karman, TornThroughByTheFrontTension)
{
  RollBite bite                   = cold_pass();
  bite.strip.flow_stress          = {FlowStressLaw::constant, 600e6, 0, 0, 0, {}};
  bite.strip.entry_tension        = 0;
  bite.strip.exit_tension         = 590e6;
  bite.strip.friction.coefficient = 0.02;
  const std::string words         = refusal([&] { solve(bite); });
  EXPECT_NE(words.find("the strip is torn through, the neutral point would lie before the entry"),
            std::string::npos)
      << words;
}

TEST(Karman, ReportsAFrictionLimitTooLowForTheDraft)
{
  RollBite bite                   = demo_pass();
  bite.strip.friction.shear_limit = 0.05;
  const std::string words         = refusal([&] { solve(bite); });
  EXPECT_NE(words.find("no friction up to its limit is enough"), std::string::npos) << words;
}

TEST(Karman, IdleRolls)
{
  RollBite bite             = demo_pass();
  bite.strip.exit_thickness = 7e-3;
  bite.strip.entry_tension  = 4e6;
  const IdleDrawing drawing = draw_through_idle_rolls(bite);
  EXPECT_TRUE(near(drawing.exit_tension - 4e6, 28e6 * std::log(8.0 / 7), within(1e-10, "homogeneous work")));
  bite.strip.exit_thickness = 2.5e-3;
  EXPECT_EQ(refusal([&] { draw_through_idle_rolls(bite); }),
            "drawing through idle rolls takes 36.57 MPa, and the flow stress of the strip at the exit is 28 MPa: "
            "it would tear; "
            "give less reduction or back tension");
}

TEST(Karman, FoilIsFlagged)
{
  RollBite bite              = cold_pass();
  bite.strip.entry_thickness = 0.1e-3;
  bite.strip.exit_thickness  = 0.09e-3;
  const BiteState s          = solve(bite);
  ASSERT_FALSE(s.notes.empty());
  EXPECT_EQ(text_of(s.notes.back()),
            "exit thickness 0.09 mm: below about 0.1 mm a zone without slip forms, in which mu p is not the "
            "friction; the force is a guide only");
}

TEST(Sims, StateAndFits)
{
  RollBite bite                   = demo_pass();
  bite.strip.friction.coefficient = 0.3;
  const BiteState s               = solve(bite, Theory::sims);
  const SimsForce f               = sims_force(0.21, 0.21, 8e-3, 5e-3, 28e6);
  EXPECT_TRUE(near(s.force, f.force, within(1e-12, "constant flow stress")));
  EXPECT_TRUE(near(s.torque, f.torque, within(1e-12, "constant flow stress")));
  EXPECT_TRUE(near(by(s.force_by, Input::exit_thickness), slope_by_exit(bite, Theory::sims, Arc::rigid, 3e-6),
                   within(1e-8, "differences")));
  const auto fits     = fitted_force_factors(0.21, 8e-3, 5e-3);
  const double length = std::sqrt(0.21 * 3e-3);
  EXPECT_TRUE(near(fits.at(0).factor * 28e6 * length, 1230.43e3, within(5e-6, "printed digits: 1230.43 N/mm")));
  for (const ForceFactor &fit : fits)
    EXPECT_NE(std::string(fit.note).find("not looked up"), std::string::npos) << fit.name;
}
