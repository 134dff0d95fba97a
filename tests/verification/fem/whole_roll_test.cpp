#include "fem/roll/contact_details.h"
#include "meshes/roll/contact_mesh_size.h"
#include "tests/support/closed_form.h"
#include "tests/support/near.h"
#include "tests/support/roll_pair.h"

// Loads that differ between the two sides of a roll: tilt, shift, bending.  Coarse meshes, since symmetry and
// direction hold on any; the identity with the whole model is the manual's case symmetry-identity.
using namespace mill;
using fem::Extent;

namespace {
const Material steel{210e9, 0.3, 7700};
const RollGeometry backup{0.3, 0.4, 0.2, 0.3, 0.55, 0}, work{0.12, 0.4, 0.08, 0.25, 0.52, 0};
constexpr double F = 4e5;  // N

fem::CondensedRoll condensed(const std::string &name, const RollGeometry &geometry)
{
  const double b = closed_form::line_contact(2 * F / 0.8, 0.24, 0.6, 210e9, 0.3).half_width;
  auto size      = meshes::roll_contact_size(b, 3, 1.5);
  size.end_layer = 0.01;
  fem::CondenseOptions options;
  options.both_sides = true;
  return meshed_roll(name, geometry, size, steel, options).roll;
}

struct Pair {
  fem::CondensedRoll backup_roll, work_roll;
};
const Pair &rolls()
{
  static const Pair made{condensed("backup", backup), condensed("work", work)};
  return made;
}

fem::ContactPair in_stand(const double strip = 0.5)
{
  const auto a = fem::held_by_necks(rolls().backup_roll, Extent::whole);
  const auto b = fem::held_by_strip(rolls().work_roll, strip, Extent::whole);
  return fem::make_pair("upper", rolls().backup_roll, a, rolls().work_roll, b, Eigen::VectorXd::Zero(a.grid.n_z));
}

fem::ContactPair shifted(const double shift)
{
  const auto a = fem::held_by_necks(rolls().backup_roll, Extent::whole);
  const auto b = fem::held_by_strip(rolls().work_roll, 0.5, Extent::whole, -shift);
  return fem::make_pair(
      "upper", rolls().backup_roll, a, rolls().work_roll, b, [](double) { return 0.; }, shift);
}
}  // namespace

TEST(WholeRoll, TiltsOfOppositeSignAreMirrorImages)
{
  auto left = in_stand(), right = in_stand();
  left.tilt = -2e-5, right.tilt = 2e-5;
  const auto a = fem::solve_load(left, F), b = fem::solve_load(right, F);
  EXPECT_TRUE(near(a.approach, b.approach, within(1e-9, "one mesh, mirrored")));
  EXPECT_TRUE(near(a.tilt, -2e-5, within(1e-9, "imposed")));
  EXPECT_TRUE(near(a.moment, -b.moment, within(1e-8, "mirrored")));
  EXPECT_GT(b.moment, 0) << "the closing side carries more";
  const auto q = fem::barrel_profile(left, a).line_load, p = fem::barrel_profile(right, b).line_load;
  EXPECT_LT((q.reverse() - p).cwiseAbs().maxCoeff(), 1e-8 * p.maxCoeff());
}

TEST(WholeRoll, ForceAndMomentAreThoseOfTheLineLoad)
{
  auto pair        = in_stand();
  pair.load_offset = 0.05;
  const auto state = fem::solve_load(pair, F);
  const auto q     = fem::barrel_profile(pair, state);
  EXPECT_TRUE(near(q.line_load.dot(pair.path), F, within(1e-10, "equilibrium")));
  EXPECT_TRUE(near(state.moment, 0.05 * F, within(1e-10, "imposed")));
  EXPECT_TRUE(near(q.line_load.cwiseProduct(pair.path).dot(q.z), 0.05 * F, within(1e-10, "equilibrium")));
  auto same = in_stand();
  same.tilt = state.tilt;
  EXPECT_TRUE(
      near(fem::solve_load(same, F).moment, state.moment, within(1e-8, "tilt and moment belong together")));
}

TEST(WholeRoll, BendingTowardsTheBackupRollLoadsTheEnds)
{
  const auto b     = fem::held_by_strip(rolls().work_roll, 0.5, Extent::whole);
  const auto plain = fem::barrel_profile(in_stand(), fem::solve_load(in_stand(), F));
  auto both        = in_stand();
  fem::bend(both, b, 2e4, 2e4);
  const auto bent = fem::barrel_profile(both, fem::solve_load(both, F));
  const auto last = bent.line_load.size() - 3;
  EXPECT_GT(bent.line_load[last], 1.02 * plain.line_load[last]);
  EXPECT_TRUE(near(bent.line_load[2], bent.line_load[last], within(1e-8, "equal forces on both sides")));
  auto one = in_stand();
  fem::bend(one, b, 2e4, 0);
  const auto half = fem::barrel_profile(one, fem::solve_load(one, F));
  EXPECT_GT(half.line_load[last], half.line_load[2]);
  // The same two forces on a quarter.
  const auto c = fem::held_by_necks(rolls().backup_roll), d = fem::held_by_strip(rolls().work_roll, 0.5);
  auto quarter =
      fem::make_pair("upper", rolls().backup_roll, c, rolls().work_roll, d, Eigen::VectorXd::Zero(c.grid.n_z));
  fem::bend(quarter, d, 2e4, 2e4);
  EXPECT_TRUE(near(fem::solve_load(quarter, F).approach, fem::solve_load(both, F).approach,
                   within(1e-9, "one state, two models")));
}

TEST(WholeRoll, CouplingOfMatchingGridsIsThatOfTheirNodes)
{
  const auto nodes = fem::solve_load(in_stand(), F), mortar = fem::solve_load(shifted(0), F);
  EXPECT_TRUE(near(mortar.approach, nodes.approach, within(2e-3, "gap at the nodes against gap in the mean")));
  EXPECT_TRUE(near(mortar.tangent, nodes.tangent, within(5e-3, "the same, one active set")));
}

TEST(WholeRoll, ShiftsOfOppositeSignAreMirrorImagesAndMoveTheContact)
{
  const auto right = shifted(0.05), left = shifted(-0.05);
  EXPECT_TRUE(near(right.grid.z[0], -0.35, within_absolute(0.02, "m, one element of the length")));
  EXPECT_TRUE(near(right.grid.z[right.grid.n_z - 1], 0.4,
                   within_absolute(1e-9, "m, the grid ends at the end of the barrel")));
  EXPECT_TRUE(near(right.path.sum(), 0.75, within(1e-9, "0.8 m less the shift")));
  const auto a = fem::solve_load(right, F), b = fem::solve_load(left, F);
  EXPECT_TRUE(near(a.approach, b.approach, within(1e-8, "mirrored")));
  EXPECT_TRUE(near(a.moment, -b.moment, within(1e-7, "mirrored")));
  EXPECT_TRUE(near(fem::barrel_profile(right, a).line_load.dot(right.path), F, within(1e-10, "equilibrium")));
}

// The active set's stiffness steps as stations join; the fitted one is the slope of the curve.
TEST(WholeRoll, FittedJointStiffnessIsTheSlopeOfTheCurve)
{
  const auto a = fem::held_by_mirror(rolls().backup_roll, Extent::whole),
             b = fem::held_by_mirror(rolls().work_roll, Extent::whole);
  const auto pair =
      fem::make_pair("upper", rolls().backup_roll, a, rolls().work_roll, b, Eigen::VectorXd::Zero(a.grid.n_z));
  const auto joint = fem::fitted_joint_stiffness(pair, F, 2 * F);
  const double slope =
      0.6 * F / (fem::solve_load(pair, 1.3 * F).approach - fem::solve_load(pair, 0.7 * F).approach);
  EXPECT_TRUE(
      near(joint(1, 1), slope, within(0.01, "a coarse mesh: a chord over 0.7 to 1.3 F crosses few steps")));
  EXPECT_TRUE(near(joint(0, 0), -F / pair.radii_sum, within(1e-12, "geometric, no fit")));
}

TEST(WholeRoll, JointStiffnessIsThatOfItsMotions)
{
  const auto a = fem::held_by_mirror(rolls().backup_roll, Extent::whole),
             b = fem::held_by_mirror(rolls().work_roll, Extent::whole);
  auto pair =
      fem::make_pair("upper", rolls().backup_roll, a, rolls().work_roll, b, Eigen::VectorXd::Zero(a.grid.n_z));
  pair.tilt        = 1e-5;
  const auto state = fem::solve_load(pair, F);
  const auto joint = fem::joint_stiffness(pair, state);
  EXPECT_TRUE(joint.isApprox(joint.transpose(), 1e-10));
  EXPECT_TRUE(near(joint(1, 1), state.tangent, within(1e-9, "force over approach at held tilt")));
  pair.tilt       = 1e-5 + 1e-11;
  const auto more = fem::solve_load(pair, F);
  // At constant force a tilt moves the approach too: dF = 0 = K_yy dy + K_yr dr,  dM = K_ry dy + K_rr dr.
  const double dM = (more.moment - state.moment) / 1e-11;
  EXPECT_TRUE(
      near(dM, joint(3, 3) - joint(1, 3) * joint(1, 3) / joint(1, 1), within(1e-5, "difference of two solves")));
  EXPECT_LT(joint(0, 0), 0);
  EXPECT_EQ(joint(5, 5), 0);
}

// Uniform contact of straight rolls: what joint_at() is compared with in closed form.
TEST(WholeRoll, JointIsComparedWithTheClosedFormsOfAUniformLoad)
{
  const auto a = fem::held_by_mirror(rolls().backup_roll, Extent::whole),
             b = fem::held_by_mirror(rolls().work_roll, Extent::whole);
  fem::ContactPairs pairs;
  pairs.closed_form = {0.24, 0.6, 0.8, steel};
  pairs.whole       = pairs.whole_coarse =
      fem::make_pair("upper", rolls().backup_roll, a, rolls().work_roll, b, Eigen::VectorXd::Zero(a.grid.n_z));
  const auto joint     = fem::joint_at(pairs, F, 2 * F);
  const double tangent = 0.8 * closed_form::line_contact(F / 0.8, 0.24, 0.6, 210e9, 0.3).tangent;
  const auto formula   = within(1e-12, "the same formula, written apart");
  EXPECT_TRUE(near(joint.tangent, tangent, formula));
  EXPECT_TRUE(near(joint.spread, tangent * 0.8 * 0.8 / 12, formula));
  EXPECT_TRUE(near(joint.sideways, -F / 0.42, formula));
  EXPECT_TRUE(near(joint.crossing, -F * 0.8 * 0.8 / 12 / 0.42, formula));
  EXPECT_TRUE(near(joint.value(0, 0), joint.sideways, within(1e-12, "geometric, no fit")));
  const auto exact = fem::joint_stiffness(pairs.whole, fem::solve_load(pairs.whole, F));
  EXPECT_TRUE(near(joint.error(1, 1), std::abs(exact(1, 1) / joint.value(1, 1) - 1),
                   within(1e-9, "one mesh twice: the active set alone")));
  EXPECT_EQ(joint.error(5, 5), 0) << "nothing resists";
}

TEST(WholeRoll, OneSidednessIsThatOfTheMotionImposed)
{
  fem::ContactPairs pairs;
  pairs.closed_form = {0.24, 0.6, 0.8, steel};
  pairs.extent      = Extent::whole;
  auto pair         = in_stand();
  pair.load_offset  = 0.05;
  pairs.mirrored = pairs.in_stand = pairs.in_stand_coarse = pair;
  const auto sides                                        = fem::one_sidedness(pairs, F);
  ASSERT_TRUE(sides);
  EXPECT_TRUE(near(sides->offset.value, 0.05, within(1e-10, "imposed")));
  EXPECT_TRUE(near(sides->tilt.value, fem::solve_load(pair, F).tilt, within(1e-12, "follows")));
  EXPECT_EQ(sides->tilt.error, 0) << "one mesh twice";
  EXPECT_EQ(sides->mirrored_offset, sides->offset.value);
}
