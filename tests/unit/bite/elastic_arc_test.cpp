#include "core/base/errors.h"
#include "reduce/bite/arc/half_plane.h"
#include "reduce/bite/slab/elastic_arc.h"
#include "reduce/bite/slab/slab_bite.h"
#include "tests/support/demo_pass.h"
#include "tests/support/friction_laws.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::bite;

namespace {
/// Thin hard strip: 0.5 -> 0.35 mm under tension.
RollBite thin_strip()
{
  RollBite bite                   = demo_pass();
  bite.roll_radius                = 0.25;
  bite.strip.width                = 1e-3;
  bite.strip.entry_thickness      = 0.5e-3;
  bite.strip.exit_thickness       = 0.35e-3;
  bite.strip.entry_tension        = 100e6;
  bite.strip.exit_tension         = 150e6;
  bite.strip.flow_stress          = {FlowStressLaw::swift, 826e6, 0.0433, 0.15, 0, {}};
  bite.strip.friction.coefficient = 0.05;
  bite.strip.youngs_modulus       = 2.1e11;
  return bite;
}

BiteState solve(const RollBite &bite, const ArcFlexibility *flexibility = nullptr, const bool derivatives = false)
{
  KarmanOptions options;
  options.derivatives = derivatives;
  return solve_karman(bite, Theory::karman, Arc::elastic, flexibility, options);
}
}  // namespace

TEST(HalfPlane, EllipticPressureFlattensToAParabola)
{
  // Hertz: p0 sqrt(1 - x^2/a^2) gives u(0) - u(x) = (1 - nu^2) p0 x^2/(E a) inside, and the datum of a full roll.
  const double a = 3e-3, p0 = 500e6, R = 0.25;
  const Material roll{2.1e11, 0.28, 7850};
  const int n                 = 401;
  const Eigen::VectorXd x     = Eigen::VectorXd::LinSpaced(n, -a, a);
  const Eigen::VectorXd p     = p0 * (1 - (x / a).array().square()).max(0).sqrt();
  const Eigen::VectorXd u     = half_plane_flexibility(x, roll, R).influence * p;
  const Eigen::VectorXd slope = half_plane_slope(x, roll) * p;
  const double plane = (1 - 0.28 * 0.28) / 2.1e11, q = 0.5 * M_PI * p0 * a;
  EXPECT_TRUE(near(u[n / 2], 2 * plane / M_PI * q * (std::log(4 * R / a) - 0.5),
                   within(3e-4, "straight between 401 points; upright ends of the ellipse")));
  for (const int i : {50, 120, 300}) {
    EXPECT_TRUE(near(u[n / 2] - u[i], plane * p0 * x[i] * x[i] / a, within(2e-3, "straight between 401 points")));
    EXPECT_TRUE(near(slope[i], -2 * plane * p0 * x[i] / a, within(5e-3, "straight between 401 points")));
  }
}

TEST(HalfPlane, ReciprocalOnEvenPoints)
{
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(21, -1e-3, 2e-3);
  const Eigen::MatrixXd c = half_plane_flexibility(x, {2.1e11, 0.28, 7850}, 0.25).influence;
  EXPECT_LT((c.block(1, 1, 19, 19) - c.block(1, 1, 19, 19).transpose()).cwiseAbs().maxCoeff(),
            1e-13 * c.maxCoeff());
  EXPECT_THROW(half_plane_flexibility(Eigen::VectorXd::Zero(3), {2.1e11, 0.28, 7850}, 0.25), InputError);
}

TEST(ElasticArc, HalfPlaneGivenAsAFlexibility)
{
  const RollBite bite             = thin_strip();
  const Eigen::VectorXd x         = Eigen::VectorXd::LinSpaced(150, -8e-3, 16e-3);
  const ArcFlexibility half_plane = half_plane_flexibility(x, bite.roll, bite.roll_radius);
  EXPECT_TRUE(near(solve(bite, &half_plane).force, solve(bite).force,
                   within(1e-5, "the difference that is interpolated is zero; "
                                "the first look for the contact differs")));
}

TEST(ElasticArc, DatumOfTheRollMovesTheScrewOnly)
{
  const RollBite bite        = thin_strip();
  const Eigen::VectorXd x    = Eigen::VectorXd::LinSpaced(150, -8e-3, 16e-3);
  const ArcFlexibility other = half_plane_flexibility(x, bite.roll, 10 * bite.roll_radius);
  EXPECT_TRUE(near(solve(bite, &other).force, solve(bite).force, within(1e-5, "the same shape up to a constant")));
}

TEST(ElasticArc, DerivativesAgainstDifferences)
{
  const RollBite bite = thin_strip();
  const BiteState s   = solve(bite, nullptr, true);
  const auto moved    = [&](const double by) {
    RollBite b = bite;
    b.strip.exit_thickness += by;
    return solve(b).force;
  };
  const double step = 3e-8;
  EXPECT_TRUE(near(s.force_by_exit_following, (moved(step) - moved(-step)) / (2 * step),
                   within(1e-2, "differences of two grids, each made for its contact")));
  EXPECT_LT(s.force_by_exit_following, by(s.force_by, Input::exit_thickness)) << "the arc that follows is steeper";
  // The derivative belongs to the limit and not to the grid.
  KarmanOptions fine;
  fine.arc_points   = 400;
  const BiteState f = solve_karman(bite, Theory::karman, Arc::elastic, nullptr, fine);
  EXPECT_TRUE(near(f.force_by_exit_following, s.force_by_exit_following, within(1e-2, "two grids")));
  EXPECT_TRUE(near(by(f.force_by, Input::exit_thickness), by(s.force_by, Input::exit_thickness),
                   within(5e-3, "two grids")));
}

TEST(ElasticArc, StateHoldsTogether)
{
  const RollBite bite = thin_strip();
  const BiteState s   = solve(bite, nullptr, true);
  double force        = 0;
  bool neutral        = false;
  for (Eigen::Index i = 1; i < s.position.size(); ++i) {
    EXPECT_GT(s.position[i], s.position[i - 1]);
    EXPECT_GT(s.pressure[i], 0);
    force += 0.5 * (s.pressure[i] + s.pressure[i - 1]) * (s.position[i] - s.position[i - 1]) * bite.strip.width;
    neutral = neutral || s.position[i] == s.neutral_position;
  }
  EXPECT_TRUE(neutral);
  EXPECT_TRUE(near(force, s.force, within(1e-3, "ends of the contact between points, neutral point among them")));
  EXPECT_LT(s.position[0], s.exit_position) << "elastic zone behind the plastic arc";
  EXPECT_GT(s.position[s.position.size() - 1], s.arc_length);
  EXPECT_LT(s.exit_position, 0);
  EXPECT_GT(s.torque, 0);
  EXPECT_TRUE(near(s.flattened_radius * (bite.strip.entry_thickness - bite.strip.exit_thickness),
                   std::pow(s.arc_length - s.exit_position, 2), within(1e-12, "definition")));
  EXPECT_EQ(s.model, "Karman slab, elastic arc");
}

// (8.12) takes the whole contact, of which the elastic zones are the larger part at a small reduction: the half
// plane under the pressure that was found, at the point where its displacement is largest.
TEST(ElasticArc, FlatteningIsThatOfTheWholeContact)
{
  for (const double reduction : {0.05, 0.1, 0.3}) {
    RollBite bite             = thin_strip();
    bite.strip.exit_thickness = (1 - reduction) * bite.strip.entry_thickness;
    const BiteState s         = solve(bite, nullptr, true);
    const auto n              = s.position.size();
    const double cells        = s.position[1] - s.position[0] + s.position[n - 1] - s.position[n - 2];
    EXPECT_GE(s.contact_length, s.position[n - 1] - s.position[0]) << reduction;
    EXPECT_LE(s.contact_length, s.position[n - 1] - s.position[0] + 2 * cells) << reduction;
    EXPECT_GT(s.contact_length, s.arc_length - s.exit_position) << "elastic zones; reduction " << reduction;
    const ArcFlexibility plane = half_plane_flexibility(s.position, bite.roll, bite.roll_radius);
    EXPECT_TRUE(near(slab_stiffness(bite, s).flattening, s.force / (plane.influence * s.pressure).maxCoeff(),
                     within(0.04, "(8.12) has an elliptic pressure, the bite a friction hill")))
        << reduction;
  }
}

TEST(ElasticArc, EveryFrictionLaw)
{
  RollBite bite   = thin_strip();
  bite.roll_speed = 10;
  for (const Friction &law : laws_of_friction()) {
    bite.strip.friction = law;
    const BiteState s   = solve(bite, nullptr, true);
    EXPECT_GT(s.neutral_position, s.exit_position) << name_of(law.law);
    EXPECT_LT(s.neutral_position, s.arc_length);
    const auto moved = [&](const double by) {
      RollBite b = bite;
      b.strip.exit_thickness += by;
      return solve(b).force;
    };
    EXPECT_TRUE(near(s.force_by_exit_following, (moved(3e-8) - moved(-3e-8)) / 6e-8,
                     within(1e-2, "differences of two grids, each made for its contact")))
        << name_of(law.law);
    if (has_film(law))
      EXPECT_TRUE(
          near(s.friction, 0.012 + 0.142 * std::exp(-2.43e6 * s.film_thickness), within(1e-9, "the law itself")));
  }
}

TEST(ElasticArc, RefusedWithoutElasticZones)
{
  RollBite bite             = thin_strip();
  bite.strip.youngs_modulus = INFINITY;
  try {
    solve(bite);
    FAIL() << "accepted";
  } catch (const InputError &e) {
    EXPECT_EQ(e.problems.at(0).message, "the elastic arc needs the strip's elastic zones, but "
                                        "strip.youngs_modulus = inf GPa: without them the pressure "
                                        "ends in a step, under which the surface of the roll has an infinite "
                                        "slope, and no grid converges. Give the "
                                        "modulus of the strip, or take Hitchcock's arc");
  }
}

TEST(ElasticArc, SurfaceGivenTooShort)
{
  const RollBite bite         = thin_strip();
  const Eigen::VectorXd x     = Eigen::VectorXd::LinSpaced(60, -2e-3, 7.2e-3);
  const ArcFlexibility narrow = half_plane_flexibility(x, bite.roll, bite.roll_radius);
  EXPECT_THROW(solve(bite, &narrow), SolverError);
}

TEST(ElasticArc, NoNeutralPoint)
{
  RollBite bite                   = thin_strip();
  bite.strip.friction.coefficient = 0.004;
  EXPECT_THROW(solve(bite), InputError);
}
