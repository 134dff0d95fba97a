#include "reduce/bearing/assembly.h"
#include "reduce/bearing/clearance.h"
#include "reduce/bearing/rigid_rings.h"
#include "reduce/bearing/roller_places.h"
#include "tests/support/demo_bearing.h"
#include "tests/support/near.h"
#include "tests/support/smooth_rings.h"
#include <Eigen/Geometry>
#include <cmath>
#include <utility>

using namespace mill;
using namespace mill::bearing;

namespace {
constexpr double degree = M_PI / 180;
const std::array<bool, 5> all_loads{false, false, false, false, false};

RingLoading loads(const double x, const double y, const double z, const double mx, const double my)
{
  RingLoading loading;
  loading.value << x, y, z, mx, my;
  loading.prescribed = all_loads;
  return loading;
}

BearingModel elastic_model(const int chock = 0, const OneRollerLaw law = OneRollerLaw::iso)
{
  RollerBearing b    = demo_bearing(20);
  b.profile          = RollerProfile::log;
  b.roller_law       = law;
  BearingModel model = rigid_model(b);
  model.rings        = smooth_rings(4, 3, 1e-9, chock);
  return model;
}

// Sum of slice forces and moments, from the geometry and not from the assembly's own matrix.
Vector5 resultant(const BearingModel &model, const AssemblyState &state)
{
  const RollerBearing &b = model.bearing;
  Vector5 sum            = Vector5::Zero();
  const double R = (b.bore + b.outside_diameter) / 4, pitch = b.width / b.rows;
  for (int r = 0; r < b.rows; ++r)
    for (int j = 0; j < b.rollers_per_row; ++j)
      for (Eigen::Index k = 0; k < model.roller.position.size(); ++k) {
        const double s = b.arrangement[std::size_t(r)] == '+' ? 1 : -1, psi = state.azimuth[j],
                     x = model.roller.position[k], ca = std::cos(b.cup_angle), sa = std::sin(b.cup_angle);
        const Eigen::Vector3d e(std::cos(psi), std::sin(psi), 0), z(0, 0, 1);
        const Eigen::Vector3d n = ca * e + s * sa * z, t = -s * sa * e + ca * z;
        const Eigen::Vector3d p = R * e + pitch * (r - (b.rows - 1) / 2.0) * z + x * t;
        const Eigen::Vector3d f = state.slice_load(k, r * b.rollers_per_row + j) * n, m = p.cross(f);
        sum += (Vector5() << f, m[0], m[1]).finished();
      }
  return sum;
}
}  // namespace

TEST(BearingAssembly, EqualsTheRigidRingSolver)
{
  for (const OneRollerLaw law : {OneRollerLaw::iso, OneRollerLaw::elastic})
    for (const double clearance : {0.0, 1e-4, -5e-5})
      for (const double tilt : {0.0, 0.4e-3}) {
        RollerBearing b     = demo_bearing(20);
        b.roller_law        = law;
        b.profile           = RollerProfile::iso;
        b.radial_clearance  = clearance;
        const auto rigid    = solve_bearing(b, 7e5, tilt);
        const auto loading  = radial_drive(7e5, tilt);
        const auto assembly = BearingAssembly(rigid_model(b)).solve(loading);
        const auto same     = within(1e-6, "two root finders; tan(tilt) against tilt in the slices");
        EXPECT_TRUE(near(assembly.motion[0], rigid.displacement, same));
        EXPECT_TRUE(near(radial_tangent(assembly, loading), rigid.tangent, same));
        EXPECT_TRUE(near(radial_secant(assembly), rigid.secant, same));
        EXPECT_LT((assembly.roller_load - rigid.roller_load).cwiseAbs().maxCoeff(), 1e-6 * rigid.roller_max);
        EXPECT_LT((assembly.row_share - rigid.row_share).cwiseAbs().maxCoeff(), 1e-6);
        EXPECT_EQ(assembly.loaded_rollers, rigid.loaded_rollers);
      }
}

TEST(BearingAssembly, SlicesBalanceTheLoad)
{
  for (const bool elastic : {false, true}) {
    BearingModel model             = elastic_model(4, OneRollerLaw::elastic);
    model.bearing.radial_clearance = 40e-6;
    if (!elastic)
      model.rings = {};
    const RingLoading loading = loads(8e5, -2e5, 1e5, 4e3, 9e3);
    const auto state          = BearingAssembly(model).solve(loading);
    const Vector5 sum         = resultant(model, state);
    for (int i = 0; i < 5; ++i)
      EXPECT_TRUE(near(sum[i], loading.value[i], within(1e-9, "equilibrium", i < 3 ? 1e6 : 1e5)));
    EXPECT_TRUE(near(state.row_axial.sum(), 1e5, within(1e-9, "axial balance", 1e6)));
    EXPECT_TRUE(near(state.row_share.sum(), 1, within(1e-9, "shares of one load")));
    EXPECT_TRUE(near(state.row_radial.sum(), std::hypot(8e5, 2e5), within(1e-9, "radial balance")));
    EXPECT_LT(state.residual, 1e-9);
  }
}

// Imposing the motion that a load has found gives the load back, component by component.
TEST(BearingAssembly, LoadAndMotionAreInverse)
{
  const BearingModel model = elastic_model(4);
  BearingAssembly assembly(model);
  const RingLoading loading = loads(8e5, 1e5, -1e5, 2e3, 9e3);
  const auto by_load        = assembly.solve(loading);
  for (int component = 0; component < 5; ++component) {
    RingLoading mixed                        = loading;
    mixed.prescribed[std::size_t(component)] = true;
    mixed.value[component]                   = by_load.motion[component];
    assembly.forget();
    const auto state = assembly.solve(mixed);
    for (int i = 0; i < 5; ++i)
      EXPECT_TRUE(near(state.load[i], loading.value[i], within(1e-8, "two Newton iterations", i < 3 ? 1e6 : 1e5)));
  }
}

TEST(BearingAssembly, StartDoesNotMatter)
{
  BearingAssembly assembly(elastic_model(4, OneRollerLaw::elastic));
  const auto cold = assembly.solve(radial_drive(1e6));
  assembly.solve(loads(1e5, 4e5, 3e5, 0, 2e4));
  const auto warm = assembly.solve(radial_drive(1e6));
  EXPECT_LT((cold.roller_load - warm.roller_load).cwiseAbs().maxCoeff(), 1e-8 * cold.roller_load.maxCoeff());
  assembly.forget();
  EXPECT_EQ(assembly.solve(radial_drive(1e6)).iterations, cold.iterations);
}

// The rings deflect by flexibility times roller loads, and take that off the approach.
TEST(BearingAssembly, RingMotionBelongsToTheRollerLoads)
{
  const BearingModel model = elastic_model(4);
  BearingAssembly assembly(model);
  const auto state        = assembly.solve(radial_drive(1e6));
  const Eigen::MatrixXd P = line_modes(model.roller.position, model.bearing.roller_length, model.rings.modes);
  const Eigen::MatrixXd N = P.transpose() * state.slice_load;
  const Eigen::VectorXd w = flexibility_at(model.rings, state.azimuth) * N.reshaped();
  EXPECT_LT((w - state.ring_motion).cwiseAbs().maxCoeff(), 1e-10 * w.cwiseAbs().maxCoeff());
  const double ca = std::cos(model.bearing.cup_angle), sa = std::sin(model.bearing.cup_angle);
  EXPECT_TRUE(near(state.roller_approach(1, 3),
                   ca * std::cos(state.azimuth[3]) * state.motion[0] +
                       ca * std::sin(state.azimuth[3]) * state.motion[1] - sa * state.motion[2] -
                       state.ring_motion[(39 + 3) * 3],
                   within(1e-12, "definition")));
  RingLoading loading = radial_drive(1e6);
  EXPECT_LT(radial_tangent(state, loading),
            0.9 * radial_tangent(BearingAssembly(rigid_model(model.bearing)).solve(loading), loading));
}

// Along the load with everything else following: the slope of the curve itself.
TEST(BearingAssembly, RadialTangentIsTheSlopeOfTheCurve)
{
  BearingAssembly assembly(elastic_model(4));
  for (RingLoading loading : {radial_drive(6e5, 0.2e-3), loads(6e5, 0, 1e5, 0, 5e3)}) {
    const auto state = assembly.solve(loading);
    RingLoading more = loading, less = loading;
    more.value[0] += 10;
    less.value[0] -= 10;
    const double slope = 20 / (assembly.solve(more).motion[0] - assembly.solve(less).motion[0]);
    EXPECT_TRUE(near(radial_tangent(state, loading), slope, within(1e-6, "central difference of the curve")));
  }
}

TEST(BearingAssembly, TurnedLoadsGiveTurnedStates)
{
  RollerBearing b = demo_bearing(20);
  BearingAssembly assembly(rigid_model(b));
  const double pitch = 2 * M_PI / 39;
  const auto along   = assembly.solve(radial_drive(5e5));
  const auto turned  = assembly.solve([&] {
    RingLoading loading;
    loading.value << 5e5 * std::cos(pitch), 5e5 * std::sin(pitch), 0, 0, 0;
    return loading;
  }());
  EXPECT_TRUE(near(turned.motion.head<2>().norm(), along.motion[0], within(1e-10, "same bearing, turned")));
  EXPECT_TRUE(near(turned.roller_load(2, 1), along.roller_load(2, 0), within(1e-9, "next roller")));
}

TEST(BearingAssembly, PreloadIsTheAxialForceOfEachRow)
{
  for (const OneRollerLaw law : {OneRollerLaw::iso, OneRollerLaw::elastic}) {
    RollerBearing b    = demo_bearing(20);
    b.roller_law       = law;
    b.preload          = 40e3;
    b.profile          = RollerProfile::iso;
    BearingModel model = rigid_model(b);
    RingLoading rest;
    rest.prescribed = {true, true, true, true, true};
    auto state      = BearingAssembly(model).solve(rest);
    for (int r = 0; r < 4; ++r)
      EXPECT_TRUE(near(std::abs(state.row_axial[r]), 40e3, within(1e-9, "axial law of a row inverted")));
    EXPECT_TRUE(near(state.load[2], 0, within(1e-9, "hands +-+- balance", 1e5)));
    model.rings = smooth_rings(4, 3, 1e-9);
    state       = BearingAssembly(model).solve(rest);
    for (int r = 0; r < 4; ++r)
      EXPECT_TRUE(near(std::abs(state.row_axial[r]), 40e3, within(1e-9, "rows set against rings that deflect")));
    // A preloaded bearing has a stiffness without load.
    EXPECT_GT(radial_tangent(BearingAssembly(model).solve(radial_drive(1.0)), radial_drive(1.0)), 1e9);
  }
  RollerBearing radial     = demo_bearing(0);
  radial.roller_cone_angle = 0;
  radial.preload           = 1e3;
  EXPECT_THROW(BearingAssembly(rigid_model(radial)), InputError);
}

// F_0 on each row by the power law: offset (F_0/(Z K_n sin a))^0.9 at the roller.
TEST(BearingAssembly, PreloadOffsetOfThePowerLaw)
{
  RollerBearing b = demo_bearing(20);
  b.preload       = 40e3;
  const double K  = roller_constant(OneRollerLaw::iso, b.roller_length);
  EXPECT_TRUE(near(BearingAssembly(rigid_model(b)).offset()[0],
                   std::pow(40e3 / (39 * K * std::sin(20 * degree)), 0.9), within(1e-9, "closed form")));
}

TEST(BearingAssembly, EndPlayIsClearance)
{
  RollerBearing play = demo_bearing(20), radial = play;
  play.end_play           = 0.2e-3;
  radial.radial_clearance = 0.2e-3 * std::tan(20 * degree);
  const auto a            = BearingAssembly(rigid_model(play)).solve(radial_drive(3e5)),
             c            = BearingAssembly(rigid_model(radial)).solve(radial_drive(3e5));
  EXPECT_TRUE(near(a.motion[0], c.motion[0], within(1e-12, "one geometry")));
  // The ring moves by half the end play until the rows of one hand touch.
  RingLoading axial;
  axial.value << 0, 0, 1, 0, 0;
  axial.prescribed = {true, true, false, true, true};
  EXPECT_TRUE(near(BearingAssembly(rigid_model(play)).solve(axial).motion[2], 0.1e-3,
                   within_absolute(1e-7, "half the end play, found on a grid of the search")));
}

TEST(BearingAssembly, HandsDecideWhichRowsCarryAxially)
{
  RollerBearing b = demo_bearing(20);
  for (const char *hands : {"+-+-", "++--", "+"}) {
    b.arrangement              = hands;
    const auto state           = BearingAssembly(rigid_model(b)).solve([] {
      RingLoading loading;
      loading.value << 0, 0, 2e5, 0, 0;
      loading.prescribed = {true, true, false, true, true};
      return loading;
    }());
    const Eigen::VectorXd hand = row_signs(b);
    const double carrying      = (hand.array() > 0).count();
    for (int r = 0; r < 4; ++r)
      EXPECT_TRUE(near(state.row_axial[r], hand[r] > 0 ? 2e5 / carrying : 0, within(1e-9, "equal rows", 1e5)));
    EXPECT_EQ(state.row_share.cwiseAbs().maxCoeff(), 0) << "no radial load, no share";
  }
}

// The roller at 90 deg is pressed by the rounding of its cosine; 40 rollers have 19 between -81 and 81 deg.
TEST(BearingAssembly, RollerAtRightAnglesCarriesNothing)
{
  RollerBearing b   = demo_bearing(20);
  b.rollers_per_row = 40;
  for (const double clearance : {0., -1e-6}) {
    b.radial_clearance = clearance;
    const auto state   = BearingAssembly(rigid_model(b)).solve(radial_drive(1e6));
    EXPECT_EQ(state.loaded_rollers[0], clearance < 0 ? 21 : 19) << "pressed by interference it does count";
  }
}

// Rollers of the power law at 90 deg, without profile: a tangent across the load has the slopes of the 15 rollers
// of each row that are pressed, and nothing of the two at the edge of contact, whatever the rounding of their
// cosine. A turn of the cage by whole pitches leaves the bearing as it is.
TEST(BearingAssembly, TheTangentAcrossHasNothingOfRollersAtRightAngles)
{
  RollerBearing b   = demo_bearing(20);
  b.rollers_per_row = 32;
  const double c    = std::cos(b.cup_angle);
  for (const int pitches : {0, 1, 2, 5, 8, 16}) {
    BearingModel model = rigid_model(b);
    model.cage_angle   = 2 * M_PI / 32 * pitches;
    const auto loading = radial_drive(1e6);
    const auto state   = BearingAssembly(model).solve(loading);
    double across      = 0;
    for (int j = -7; j <= 7; ++j) {
      const double psi = 2 * M_PI / 32 * j, d = c * state.motion[0] * std::cos(psi);
      across += 4 * 10. / 9 * roller_constant(OneRollerLaw::iso, b.roller_length) * std::pow(d, 1. / 9) *
                std::pow(c * std::sin(psi), 2);  // (5.2), (5.14)
    }
    EXPECT_TRUE(near(stiffness_along(state, loading, 1), across,
                     within(1e-9, "equilibrium to 1e-10 of the load, its slope of power 1/9")))
        << pitches;
  }
}

// A turn of the ring presses roller j by (p x n).theta: worked out from the vectors, row by row.
TEST(BearingAssembly, ATurnPressesByItsFullMoment)
{
  const RollerBearing b = demo_bearing(20);
  RingLoading loading;
  loading.prescribed = {true, true, true, true, true};
  loading.value      = {0, 0, 0, 1e-4, 2e-4};
  const auto state   = BearingAssembly(rigid_model(b)).solve(loading);
  const double a = b.cup_angle, R = 0.25 * (b.bore + b.outside_diameter);
  const double hand[] = {1, -1, 1, -1};
  for (int r = 0; r < 4; ++r)
    for (int j = 0; j < 39; ++j) {
      const double psi = state.azimuth[j];
      const Eigen::Vector3d p(R * std::cos(psi), R * std::sin(psi), (r - 1.5) * b.width / 4),
          n(std::cos(a) * std::cos(psi), std::cos(a) * std::sin(psi), hand[r] * std::sin(a));
      EXPECT_TRUE(near(state.roller_approach(r, j), Eigen::Vector3d(1e-4, 2e-4, 0).dot(p.cross(n)),
                       within_absolute(1e-15, "rounding of 1e-4 rad times half a metre")));
    }
}

// Turned by a pitch: 0.01 % without clearance, 1.7 % with 0.1 mm at 1 MN, rigid rings, ISO law.
TEST(CageVariation, OverOnePitch)
{
  RollerBearing b   = demo_bearing(20);
  const auto spread = [](const CageVariation &v) {
    return 100 * (v.tangent.maxCoeff() / v.tangent.minCoeff() - 1);
  };
  EXPECT_TRUE(near(spread(cage_variation(rigid_model(b), radial_drive(1e6), 16)), 0.01,
                   within_absolute(0.005, "printed with two decimals")));
  b.radial_clearance = 1e-4;
  EXPECT_TRUE(near(spread(cage_variation(rigid_model(b), radial_drive(1e6), 16)), 1.7,
                   within_absolute(0.06, "printed with one decimal")));
  const auto elastic = cage_variation(elastic_model(4), radial_drive(1e6), 4);
  EXPECT_EQ(elastic.angle.size(), 4);
  EXPECT_LT(spread(elastic), 5);
  EXPECT_THROW(cage_variation(rigid_model(b), radial_drive(1e6), 0), InputError);
}

TEST(BearingAssembly, CentrifugalForceHoldsTheLeastLoad)
{
  BearingModel model      = rigid_model(demo_bearing(20));
  model.centrifugal_force = 500;
  const auto state        = BearingAssembly(model).solve(radial_drive(2e5));
  const auto still        = BearingAssembly(rigid_model(demo_bearing(20))).solve(radial_drive(2e5));
  EXPECT_GT(state.roller_load.minCoeff(), 400);
  EXPECT_TRUE(near(state.load[0], 2e5, within(1e-9, "forces of a full ring balance")));
  EXPECT_LE(state.loaded_rollers.sum(), still.loaded_rollers.sum());
  EXPECT_GE(state.inner_load.minCoeff(), 0);
  EXPECT_GT(state.roller_load.maxCoeff(), still.roller_load.maxCoeff());
}

TEST(BearingAssembly, ReportsWhyEquilibriumFails)
{
  RollerBearing single = demo_bearing(20);
  single.rows          = 1;
  RingLoading loading;
  loading.value << 1e5, 0, 0, 0, 0;
  loading.prescribed = {false, false, false, true, true};
  try {
    BearingAssembly(rigid_model(single)).solve(loading);
    FAIL() << "a single row cannot carry a radial load alone";
  } catch (const SolverError &error) {
    EXPECT_EQ(error.report.what, "bearing trb: no equilibrium under F_x = 100 kN");
    EXPECT_NE(error.report.cause.find("axially"), std::string::npos);
    EXPECT_NE(error.report.where.find("rollers loaded"), std::string::npos);
  }
  RollerBearing loose    = demo_bearing(20);
  loose.radial_clearance = 1e-4;
  EXPECT_THROW(BearingAssembly(rigid_model(loose)).solve(radial_drive(0)), SolverError);
  RingLoading held;
  held.prescribed = {true, true, true, true, true};
  const auto rest = BearingAssembly(rigid_model(loose)).solve(held);
  EXPECT_EQ(rest.tangent.cwiseAbs().maxCoeff(), 0) << "imposed and not touching is a state";
  RollerBearing cylindrical     = demo_bearing(0);
  cylindrical.roller_cone_angle = 0;
  RingLoading axial             = radial_drive(1e5);
  axial.value[2]                = 1e3;
  axial.prescribed[2]           = false;
  EXPECT_THROW(BearingAssembly(rigid_model(cylindrical)).solve(axial), SolverError);
  RingLoading nan = radial_drive(NAN);
  EXPECT_THROW(BearingAssembly(rigid_model(loose)).solve(nan), InputError);
}

TEST(BearingAssembly, CurveKeepsWhatConverged)
{
  RollerBearing single = demo_bearing(20);
  single.rows          = 1;
  const auto value_at  = [](double radial, double axial) {
    RingLoading loading;
    loading.value << radial, 0, axial, 0, 0;
    loading.prescribed = {false, false, false, true, true};
    return loading;
  };
  const auto curve = BearingAssembly(rigid_model(single))
                         .curve({value_at(1e5, 1e5), value_at(2e5, 1e5), value_at(2e5, 0), value_at(1e5, 1e5)});
  EXPECT_EQ(curve.states.size(), 2u);
  ASSERT_TRUE(curve.failure);
  EXPECT_NE(curve.failure->what.find("F_x = 200 kN"), std::string::npos);
  EXPECT_EQ(curve.failure->kept, "2 of 4 states");
  EXPECT_FALSE(BearingAssembly(rigid_model(single)).curve({value_at(1e5, 1e5)}).failure);
}

TEST(BearingAssembly, AnyMixOfLoadsConverges)
{
  int most = 0, solved = 0;
  for (const char *hands : {"+-+-", "++--"})
    for (const OneRollerLaw law : {OneRollerLaw::iso, OneRollerLaw::elastic})
      for (const double clearance : {0.0, 1e-4, -5e-5, 2e-3})
        for (const bool elastic : {false, true}) {
          BearingModel model             = elastic_model(3, law);
          model.bearing.arrangement      = hands;
          model.bearing.radial_clearance = clearance;
          if (!elastic)
            model.rings = {};
          BearingAssembly assembly(model);
          for (const RingLoading &loading :
               {loads(1e6, 0, 0, 0, 0), loads(1e6, 3e5, 1e5, 1e3, -2e4), loads(0, 0, 1e5, 0, 0),
                loads(0, 0, 0, 0, 1e4), loads(1e2, 0, -3e5, 0, 5e4), loads(1, 0, 0, 0, 0),
                loads(5e6, -3e6, 1e6, 1e5, 1e5)}) {
            assembly.forget();
            const auto state = assembly.solve(loading);
            EXPECT_LT(state.residual, 1e-7);
            most = std::max(most, state.iterations);
            ++solved;
          }
        }
  EXPECT_EQ(solved, 2 * 2 * 4 * 2 * 7);
  EXPECT_LE(most, 60);
}

TEST(BearingAssembly, RefusesContradictions)
{
  const auto built = [](RollerBearing b) { return BearingAssembly(rigid_model(b)); };
  RollerBearing b  = demo_bearing(20);
  b.arrangement    = "+x";
  EXPECT_THROW(built(b), InputError);
  b       = demo_bearing(20);
  b.width = not_given;
  EXPECT_THROW(built(b), InputError);
  EXPECT_THROW(built(demo_bearing(13.5)), InputError) << "apex not closed";
  BearingModel model = elastic_model();
  model.rings        = smooth_rings(2, 3, 1e-9);
  EXPECT_THROW(BearingAssembly(std::move(model)), InputError);
}

// Work is counted, not timed: a load that follows another starts from its state, and Newton's method then needs
// few steps; each costs one pass over 4 x 39 rollers and one solution with the rings.
TEST(BearingAssembly, ACurveTakesFewSteps)
{
  BearingAssembly assembly(elastic_model(20, OneRollerLaw::elastic));
  std::vector<RingLoading> loadings;
  for (int i = 1; i <= 20; ++i)
    loadings.push_back(radial_drive(1e5 * i));
  const auto curve = assembly.curve(loadings);
  ASSERT_EQ(curve.states.size(), 20u);
  int steps = 0;
  for (const auto &state : curve.states)
    steps += state.iterations;
  EXPECT_GT(steps, 0);
  EXPECT_LE(steps, 20 * 10);
}
