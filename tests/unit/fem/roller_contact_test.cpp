// One roller between its raceways on a coarse mesh: what must hold on any mesh, and what is refused.
#include "core/base/errors.h"
#include "fem/bearing/roller_contact.h"
#include "fem/bearing/roller_slices.h"
#include "meshes/bearing/roller.h"
#include "reduce/bearing/roller_law.h"
#include "tests/support/near.h"
#include <Eigen/Dense>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace mill;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
RollerSetup short_roller()
{
  RollerSetup s;
  s.diameter     = 0.0215;
  s.length       = 0.012;
  s.inner_radius = 0.1448;
  s.outer_radius = 0.1663;
  s.inner_depth = s.outer_depth = 0.012;
  s.land                        = 0.002;
  s.largest_load                = 20e3;
  s.elements_per_half_width     = 0.5;
  s.end_element                 = 0.8e-3;
  s.largest_element             = 3e-3;
  return s;
}

fem::CondensedRoller condensed(const RollerSetup &setup)
{
  const auto meshes = meshes::mesh_roller(setup, std::filesystem::temp_directory_path().string(),
                                          "millstand-roller-contact-" + std::to_string(getpid()));
  auto roller       = fem::condense_roller(setup, meshes);
  meshes::remove_meshes(meshes);
  return roller;
}

const fem::CondensedRoller &roller()
{
  static const fem::CondensedRoller made = condensed(short_roller());
  return made;
}

double crown(const double x)
{
  return 4e-6 * std::pow(x / 0.006, 2);
}
const auto rounding = within(1e-10, "the same equations, solved by a dense Cholesky factor of condition 1e5");
}  // namespace

TEST(RollerSetup, FillsDefaultsAndNamesWhatIsMissing)
{
  RollerSetup s     = short_roller();
  s.land            = 0;
  s.end_element     = 0;
  const auto filled = completed(s);
  EXPECT_EQ(filled.contact_length, s.length);
  EXPECT_EQ(filled.land, 0.5 * s.diameter);
  EXPECT_GT(filled.finest_load, 0);
  const auto coarse = coarsened(s);
  EXPECT_EQ(coarse.end_element, 2 * filled.end_element);
  EXPECT_EQ(coarse.finest_load, filled.finest_load) << "else coarsening would change what is resolved";
  RollerSetup crushed  = s;
  crushed.largest_load = 1e9;
  const auto limited   = completed(crushed);
  EXPECT_TRUE(near(line_half_width(limited, -limited.outer_radius, limited.largest_load / limited.contact_length),
                   0.04 * s.diameter, rounding));
  const auto refused = [&](double RollerSetup::*member, const double value) {
    RollerSetup bad = short_roller();
    bad.*member     = value;
    EXPECT_THROW(completed(bad), InputError);
  };
  refused(&RollerSetup::diameter, 0);
  refused(&RollerSetup::inner_depth, -1);
  refused(&RollerSetup::largest_load, 0);
  refused(&RollerSetup::contact_length, 0.013);
  refused(&RollerSetup::outer_radius, 0.01);
  refused(&RollerSetup::elements_per_half_width, 0);
}

TEST(RollerSetup, HalfWidthIsThatOfHertz)
{
  // 10 kN on 33.4 mm: 0.184 mm on the cone and 0.197 mm on the cup, table of the roller laws.
  const auto printed = within(0.003, "three digits printed");
  const double q     = 10e3 / 0.0334;
  EXPECT_TRUE(near(line_half_width(short_roller(), 0.1448, q), 0.184e-3, printed));
  EXPECT_TRUE(near(line_half_width(short_roller(), -0.1663, q), 0.197e-3, printed));
}

TEST(CondensedRoller, FlexibilityIsSymmetricAndPositiveAndMirrorsItself)
{
  const MatrixXd C = fem::pair_flexibility(roller());
  EXPECT_EQ((C - C.transpose()).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(Eigen::LLT<MatrixXd>(C).info(), Eigen::Success);
  const auto &grid = roller().grid;
  ASSERT_EQ(C.rows(), 2 * grid.area.size());
  double worst = 0;
  for (int k = 0; k < grid.n_z; ++k) {
    EXPECT_TRUE(near(grid.z[k], -grid.z[grid.n_z - 1 - k], within(1e-15, "the other half is a copy", 1)));
    for (int l = 0; l < grid.n_z; ++l)
      worst = std::max(worst, std::abs(C(k * grid.n_x, l * grid.n_x) -
                                       C((grid.n_z - 1 - k) * grid.n_x, (grid.n_z - 1 - l) * grid.n_x)));
  }
  EXPECT_LT(worst, 1e-15 * C.maxCoeff());
}

TEST(RollerContact, PlayIsAStateAndTheFirstTouchIsAtTheClearance)
{
  const double play = 10e-6;
  fem::RollerContact contact(roller(), [&](double x) { return 0.5 * play + crown(x); });
  const auto apart = contact.solve(0.99 * play, 0);
  EXPECT_EQ(apart.load, 0);
  EXPECT_EQ(apart.tangent.norm(), 0);
  EXPECT_EQ(apart.inner.peak_pressure, 0);
  EXPECT_GT(contact.solve(1.01 * play, 0).load, 0);
  EXPECT_EQ(contact.solve(0.5 * play, 0).load, 0) << "after a state with contact";
}

TEST(RollerContact, ImposedLoadAndImposedApproachAreOneState)
{
  fem::RollerContact contact(roller(), crown);
  for (const double load : {20., 2e3, 15e3}) {
    const auto by_load     = contact.solve_load(load, 3e-4);
    const auto by_approach = contact.solve(by_load.approach, 3e-4);
    EXPECT_TRUE(near(by_load.load, load, rounding));
    EXPECT_TRUE(near(by_approach.load, load, rounding));
    EXPECT_TRUE(near(by_approach.moment, by_load.moment, rounding));
  }
  EXPECT_THROW(contact.solve_load(0), InputError);
}

TEST(RollerContact, ScalesWithTheModulus)
{
  RollerSetup soft = short_roller();
  soft.material    = {20.6e9, 0.3, 7850};
  soft.largest_load /= 10;  // the same half widths, the same mesh
  const fem::CondensedRoller other = condensed(soft);
  fem::RollerContact contact(roller(), crown), of_soft(other, crown);
  const auto a = contact.solve(12e-6, 5e-4), b = of_soft.solve(12e-6, 5e-4);
  EXPECT_TRUE(near(a.load, 10 * b.load, rounding));
  EXPECT_TRUE(near(a.moment, 10 * b.moment, rounding));
}

TEST(RollerContact, SidesWithMoreApproachCarryMore)
{
  fem::RollerContact contact(roller());
  const auto state = contact.solve(10e-6, 5e-4);
  EXPECT_GT(state.moment, 0);
  const auto n = state.inner.line_load.size();
  EXPECT_GT(state.inner.line_load[3 * n / 4], state.inner.line_load[n / 4]);
  EXPECT_GT(state.inner.peak_pressure, state.outer.peak_pressure) << "the convex raceway has the narrower contact";
}

TEST(RollerContact, MoreLoadThanTheMeshWasMadeForIsRefused)
{
  fem::RollerContact contact(roller());
  EXPECT_THROW(contact.solve_load(50 * short_roller().largest_load), SolverError);
}

TEST(RollerContact, AProfileWithoutEndTouchesNowhereNearIt)
{
  fem::RollerContact contact(roller(), [](double x) { return -1e-5 * std::log(1 - std::pow(x / 0.006, 2)); });
  const auto state = contact.solve_load(5e3);
  EXPECT_EQ(state.inner.line_load[0], 0);
  EXPECT_TRUE(std::isfinite(state.approach));
}

TEST(SliceLaw, InfluenceIsPositiveAndDoesNotDependOnTheNumberOfSlices)
{
  const auto coarse = fem::fe_roller_law(roller(), 15), fine = fem::fe_roller_law(roller(), 45);
  for (const auto *law : {&coarse, &fine}) {
    EXPECT_EQ((law->influence - law->influence.transpose()).cwiseAbs().maxCoeff(), 0);
    const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(law->influence);
    // At p_ref / e the slope of the local term is zero: the law is monotone below if the rest is positive.
    EXPECT_GT(modes.eigenvalues()[0], 0);
    EXPECT_TRUE(near(law->position.sum(), 0, within(1e-12, "slices lie symmetrically", 1)));
  }
  // Even line load: the work of three slices is that of one.
  const double a = VectorXd::Ones(15).dot(coarse.influence * VectorXd::Ones(15)) / (15 * 15),
               b = VectorXd::Ones(45).dot(fine.influence * VectorXd::Ones(45)) / (45 * 45);
  EXPECT_TRUE(
      near(a, b, within(1e-9, "the spread of an even load is the same but for rounding of its integrals")));
  EXPECT_THROW(fem::fe_roller_law(roller(), 0), InputError);
  EXPECT_THROW(fem::fe_roller_law(roller(), 15, {}, 1e3 * short_roller().largest_load), InputError);
}

TEST(SliceLaw, DoesNotDependOnTheReferenceLoad)
{
  // Where the local term takes over from the spread: same approach at an even load from references 4 times apart.
  const double load = 5e3;
  const auto high = fem::fe_roller_law(roller(), 15, crown), low = fem::fe_roller_law(roller(), 15, crown, 13.6e3);
  EXPECT_TRUE(
      near(bearing::roller_approach(low, load), bearing::roller_approach(high, load),
           within(0.004, "the logarithm is that of the plane; towards the ends and over three elements across "
                         "the contact the spread is not")));
}

TEST(SliceLaw, FollowsTheNodesOnACoarseMesh)
{
  fem::RollerContact contact(roller(), crown);
  const auto law   = fem::fe_roller_law(roller(), 31, crown);
  const auto state = contact.solve_load(10e3);
  EXPECT_TRUE(near(bearing::roller_approach(law, 10e3), state.approach,
                   within(0.02, "half widths of one element and less leave 2 % of the load (fe-mesh-order)")));
}
