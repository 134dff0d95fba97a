// Friction laws, what the closed theories refuse and in which words, identities of the moving gap, maps of K4.
#include "core/base/errors.h"
#include "core/laws/friction_law.h"
#include "reduce/bite/linear/linear_coefficients.h"
#include "reduce/bite/linear/stiffness_map.h"
#include "reduce/bite/slab/flattening.h"
#include "tests/support/demo_pass.h"
#include "tests/support/film_pass.h"
#include "tests/support/near.h"

using namespace mill;
using namespace mill::bite;

namespace {
const SlabModel bland_ford{Theory::bland_ford, Arc::rigid}, hu_ehmann{Theory::hu_ehmann, Arc::rigid};

std::string message_of(const RollBite &bite, const SlabModel &model)
{
  try {
    solve_slab(bite, model);
  } catch (const InputError &error) {
    return error.problems.at(0).message;
  }
  return "accepted";
}
}  // namespace

TEST(SlabFriction, Laws)
{
  const Friction film = film_pass().strip.friction;
  EXPECT_TRUE(near(film_friction(film, 0.890293031e-6), 0.0283204, within(2e-6, "printed with six digits")));
  EXPECT_TRUE(near(film_friction(film, 0.0), 0.154, within(1e-14, "0.012 + 0.142")));
  // 1 - exp(-gamma p) = gamma p for a thin oil: the film no longer knows gamma.
  Friction thin           = film;
  thin.pressure_viscosity = 1e-22;
  const Inlet<double> in{10, 8, 12, 0.5, 0.01, 600e6};
  EXPECT_TRUE(near(film_thickness(thin, in), 3 * 0.005 * 0.5 * 18 * 40 / (0.01 * 22 * 600e6),
                   within(1e-12, "limit; without expm1 it would be infinite")));
  Friction speed;
  speed.law           = FrictionLaw::speed;
  speed.at_unit_speed = 0.066723;
  speed.per_log_speed = -0.00662;
  EXPECT_TRUE(near(coulomb_coefficient(speed, in), 0.066723 - 0.00662 * std::log(10.0), within(1e-14, "formula")));
}

TEST(SlabErrors, FrictionAndSpeed)
{
  RollBite bite   = film_pass();
  bite.roll_speed = not_given;
  EXPECT_EQ(message_of(bite, bland_ford),
            "strip.friction.law = \"film\" depends on the speed of the rolls, which is "
            "not given; give it, or use law \"coulomb\"");
  bite                          = film_pass();
  bite.strip.friction.viscosity = 0;
  EXPECT_EQ(message_of(bite, bland_ford),
            "strip.friction: a film needs a positive viscosity, pressure_viscosity and film_factor");
  bite                    = film_pass();
  bite.strip.friction.mu0 = 0;
  EXPECT_EQ(message_of(bite, bland_ford), "strip.friction: the film law needs mu0 > 0, mu1 >= 0 and decay >= 0");
  bite                         = film_pass();
  bite.strip.flow_stress.law   = FlowStressLaw::power;
  bite.strip.entry_tension     = 0;
  bite.strip.initial_thickness = not_given;
  EXPECT_EQ(
      message_of(bite, bland_ford),
      "strip.friction.law = \"film\": the strip yields at no pressure at the entry, so the film has nothing to "
      "carry there; a flow stress law that starts above zero is needed");
  bite            = film_pass();
  bite.roll_speed = -1;
  EXPECT_EQ(message_of(bite, bland_ford), "the roll speed of -1 m/s must be positive");
  bite                              = film_pass();
  bite.strip.friction               = {};
  bite.strip.friction.law           = FrictionLaw::speed;
  bite.strip.friction.at_unit_speed = 0.02;
  bite.strip.friction.per_log_speed = -0.01;
  EXPECT_EQ(message_of(bite, bland_ford),
            "strip.friction: the speed law gives mu = -0.009014 at 18.2 m/s; it must be positive");
  bite          = demo_pass();
  bite.gap_rate = 0.01;
  EXPECT_EQ(message_of(bite, bland_ford),
            "a gap that opens at 0.01 m/s moves the exit of the strip by an amount that "
            "depends on the roll speed; the roll speed is not given");
  EXPECT_EQ(
      message_of(factor_pass(), bland_ford),
      "strip.friction.law = \"factor\" has no Coulomb coefficient: this theory needs coulomb, speed or film; the "
      "theory of Hu and Ehmann takes factors (m is about 2 mu p / k)");
  EXPECT_EQ(
      message_of(demo_pass(), hu_ehmann),
      "strip.friction.law = \"coulomb\": the theory of Hu and Ehmann takes friction factors; law \"factor\" with "
      "entry_factor and exit_factor (m is about 2 mu p / k), or another theory");
  bite                             = factor_pass();
  bite.strip.friction.entry_factor = 1.2;
  EXPECT_EQ(message_of(bite, hu_ehmann),
            "strip.friction: entry_factor = 1.2 and exit_factor = 0.12 must lie between 0 "
            "and 1, and not both be 0");
}

// Least factor: (k ln(h_e/h_d) + sigma_e - sigma_d) / (k C), C = (1 - h_d/R) sqrt(R/h_d) atan sqrt(dh/h_d) +
// x_e/R; 345.65 MPa / (1200 MPa * 8.1815) = 0.03521.
TEST(SlabErrors, NeutralPointOfFactors)
{
  RollBite bite                    = factor_pass();
  bite.strip.friction.entry_factor = 0.01;
  bite.strip.friction.exit_factor  = 0.01;
  EXPECT_EQ(
      message_of(bite, hu_ehmann),
      "strip.friction.entry_factor = 0.01 is too small for an angle of bite of 0.04795 rad: the rolls cannot pull "
      "the strip through, the neutral point would lie beyond the exit; more than 0.03521 is needed, or a smaller "
      "reduction, more front tension or less back tension");
  bite.strip.friction.entry_factor = 0.0353;
  EXPECT_EQ(message_of(bite, hu_ehmann), "accepted");
  bite.strip.friction.entry_factor = 0.0352;
  EXPECT_NE(message_of(bite, hu_ehmann), "accepted");
  bite.strip.exit_tension = 1.1e9;
  EXPECT_NE(message_of(bite, hu_ehmann).find("the strip is torn through"), std::string::npos);
}

TEST(SlabErrors, ElasticArcNeedsAnIntegratedTheory)
{
  EXPECT_EQ(
      message_of(demo_pass(), {Theory::bland_ford, Arc::elastic}),
      "the theory of Bland and Ford is closed on circular arcs only; take the Karman slab for an elastic arc");
  EXPECT_EQ(
      message_of(factor_pass(), {Theory::hu_ehmann, Arc::elastic}),
      "the theory of Hu and Ehmann is closed on circular arcs only; take the Karman slab for an elastic arc");
}

TEST(SlabNotes, FarFlattenedRoll)
{
  RollBite bite                   = factor_pass();
  bite.strip.friction             = {};
  bite.strip.friction.coefficient = 0.0527;
  bite.strip.entry_thickness      = 0.105e-3;
  bite.strip.exit_thickness       = 0.095e-3;
  bite.strip.flow_stress.k        = 1.53e9;
  const BiteState state           = solve_slab(bite, {Theory::bland_ford, Arc::hitchcock});
  EXPECT_GT(state.flattened_radius / bite.roll_radius, 5);
  bool message = false;
  for (const Warning &note : state.notes)
    message = message || note.id == WarningId::bite_flattening;
  EXPECT_TRUE(message);
}

TEST(SlabNotes, NoFlattenedRadiusInWords)
{
  RollBite bite   = film_pass();
  bite.roll_speed = 1;
  try {
    solve_slab(bite, {Theory::bland_ford, Arc::hitchcock});
    FAIL() << "a radius was returned";
  } catch (const SolverError &error) {
    EXPECT_EQ(error.report.what, "roll bite: no flattened radius");
    EXPECT_EQ(error.report.where.find("R'/R = "), 0u);
    EXPECT_NE(error.report.cause.find("(entry thickness 0.789 mm, exit thickness 0.577 mm)"), std::string::npos);
    EXPECT_EQ(error.report.remedy,
              "a smaller work roll, less friction, more tension, or a thicker strip.exit_thickness");
    EXPECT_EQ(error.report.where.find("nan"), std::string::npos);
  }
}

// The quickened iteration must end where the plain one ends, for forces that are convex, concave and kinked in R'.
TEST(Flattening, FirstRootOfAnyRisingForce)
{
  RollBite bite = demo_pass();
  const double per_force =
      bite.roll_radius * flattening_compliance(bite) / (bite.strip.entry_thickness - bite.strip.exit_thickness);
  const auto force_for = [&](const auto &phi) {  // so that Phi(R') = phi(R'/R) R
    return [&, phi](const double radius) {
      return (phi(radius / bite.roll_radius) - 1) * bite.roll_radius / per_force;
    };
  };
  const auto rises = within(1e-12, "fixed point");
  const auto root = [&](const auto &phi) { return flattened_arc(bite, force_for(phi)).radius / bite.roll_radius; };
  EXPECT_TRUE(near(root([](double r) { return 1.5 + 0.05 * r * r; }), 10 - std::sqrt(70.0), rises));
  EXPECT_TRUE(near(root([](double r) { return 1 + std::sqrt(r); }), (3 + std::sqrt(5.0)) / 2, rises));
  // A step between two plateaus: the first root is 2, a second lies at 5.
  EXPECT_TRUE(near(root([](double r) { return r < 3 ? 2.0 : 5.0; }), 2, rises));
  EXPECT_TRUE(near(root([](double r) { return r < 1.5 ? 1.6 : 4.0; }), 4, rises));
  // A wave with many roots, the first where cos(2 r - 1.2) = -0.05/0.12; a secant overshoots it.
  EXPECT_TRUE(near(root([](double r) { return r + 0.12 * std::cos(2 * r - 1.2) + 0.05; }),
                   (1.2 + std::acos(-0.05 / 0.12)) / 2, rises));
  EXPECT_THROW(root([](double r) { return 1.01 + r; }), SolverError);
  EXPECT_THROW(root([](double r) { return 1.2 + 0.4 * r * r; }), SolverError);
  EXPECT_LE(flattened_arc(bite, force_for([](double r) { return 1.5 + 0.05 * r * r; })).evaluations, 9);
}

TEST(Flattening, ForcesFarFromTheRootMayBeNan)
{
  const RollBite bite = demo_pass();
  EXPECT_THROW(flattened_arc(bite, [](double) { return not_given; }), SolverError);
}

// Volume, and the particle that leaves where it stops getting thinner.
TEST(MovingGap, Identities)
{
  for (const double rate : {0.02, -0.02}) {
    RollBite bite       = film_pass();
    bite.roll_radius    = 0.526;
    bite.gap_rate       = rate;
    const BiteState s   = solve_slab(bite, bland_ford);
    const double h_exit = bite.strip.exit_thickness + s.exit_position * s.exit_position / bite.roll_radius;
    const auto exact    = within(1e-12, "exact equations");
    EXPECT_TRUE(near(s.entry_speed * bite.strip.entry_thickness - s.exit_speed * h_exit,
                     rate * (s.arc_length - s.exit_position), exact));
    EXPECT_TRUE(near(2 * s.exit_position * s.exit_speed / bite.roll_radius, rate, exact));
    EXPECT_TRUE(near(s.slip[0], s.forward_slip, within(1e-12, "curve ends at the exit")));
    EXPECT_TRUE(near(s.slip[100], 0, within_absolute(1e-14, "no slip at the neutral point, rounding")));
    EXPECT_EQ(s.shear[100], 0);
    EXPECT_LT(s.shear[0], 0);
    EXPECT_GT(s.shear[200], 0);
  }
}

// Without a gap rate the speed of the rolls is only a scale.
TEST(MovingGap, CoulombDoesNotKnowTheSpeed)
{
  RollBite bite           = demo_pass();
  const BiteState unknown = solve_slab(bite, bland_ford);
  bite.roll_speed         = 3;
  const BiteState known   = solve_slab(bite, bland_ford);
  EXPECT_EQ(known.force, unknown.force);
  EXPECT_TRUE(std::isnan(unknown.exit_speed));
  EXPECT_TRUE(near(known.exit_speed, 3 * (1 + unknown.forward_slip), within(1e-14, "volume")));
  EXPECT_EQ(by(known.force_by, Input::roll_speed), 0);
}

TEST(LinearCoefficients, NeedASpeed)
{
  const RollBite bite = demo_pass();
  EXPECT_THROW(linear_coefficients(bite, solve_slab(bite, bland_ford), Linearisation::implicit), InputError);
}

TEST(StiffnessMap, AgreesWithSingleStatesAndKeepsReasons)
{
  const RollBite bite = demo_pass();
  const MapAxis reduction{MapQuantity::reduction, Eigen::VectorXd::LinSpaced(7, 0, 0.6)};
  const MapAxis friction{MapQuantity::friction, Eigen::VectorXd::LinSpaced(5, 0.02, 0.3)};
  const SlabModel model{Theory::bland_ford, Arc::hitchcock};
  const StiffnessMap map = stiffness_map(bite, model, reduction, friction);
  const StiffnessMap one = stiffness_map(bite, model, reduction, friction, 1);
  int states             = 0;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 5; ++j) {
      RollBite b                   = bite;
      b.strip.exit_thickness       = 8e-3 * (1 - 0.1 * i);
      b.strip.friction.coefficient = 0.02 + 0.07 * j;
      if (map.reason(i, j) >= 0) {
        EXPECT_TRUE(std::isnan(map.slope(i, j)));
        EXPECT_EQ(map.reasons.at(map.reason(i, j)), message_of(b, model));
      } else {
        ++states;
        const BiteState s = solve_slab(b, model);
        EXPECT_TRUE(near(map.slope(i, j), slab_stiffness(b, s).plastic_slope, within(1e-12, "same state")));
        EXPECT_TRUE(near(map.force(i, j), s.force, within(1e-12, "same state")));
        EXPECT_EQ(map.slope(i, j), one.slope(i, j));
      }
    }
  EXPECT_GT(states, 15);
  EXPECT_EQ(map.reason(0, 0), 0);  // no reduction
  EXPECT_GE(map.reasons.size(), 2u);
  RollBite film = film_pass();
  EXPECT_THROW(stiffness_map(film, model, reduction, friction), InputError);
  EXPECT_THROW(stiffness_map(bite, model, {MapQuantity::reduction, {}}, friction), InputError);
  const StiffnessMap speeds =
      stiffness_map(film, model, {MapQuantity::roll_speed, Eigen::VectorXd::LinSpaced(3, 1, 18.2)},
                    {MapQuantity::exit_tension, Eigen::VectorXd::Constant(1, 189e6)});
  EXPECT_EQ(speeds.reason(0, 0), 0);
  EXPECT_EQ(speeds.reasons[0].find("roll bite: no flattened radius: R'/R = "), 0u);
  EXPECT_TRUE(
      near(speeds.force(2, 0), 8736293.890034175, within(1e-8, "published condition, independent program")));
}
