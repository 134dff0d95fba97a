#include "tests/manual/solvers/full_contact.h"
#include "tests/support/closed_form.h"
#include "tests/support/near.h"
#include "tests/support/roll_pair.h"

// Work roll 420 and backup roll 1450 x 1400 mm with their necks, three-dimensional.
using namespace mill;

namespace {
const Material steel{210e9, 0.28, 7700};
const RollGeometry backup{0.725, 0.7, 0.475, 0.95, 1.225, 0}, work{0.210, 0.7, 0.13335, 0.46, 1.0, 0};
constexpr double F1 = 976217.5, F2 = 737992.5;  // N, two passes

double half_width(const double F)
{
  return closed_form::line_contact(F / 1.4, 0.420, 1.450, 210e9, 0.28).half_width;
}

struct Rolls {
  MeshedBody backup_roll, work_roll;
};

Rolls rolls(const double largest_load, const int per_half_width)
{
  const auto size = meshes::roll_contact_size(half_width(largest_load), per_half_width);
  return {meshed_roll("backup", backup, size, steel), meshed_roll("work", work, size, steel)};
}

const Rolls &shared_rolls()
{
  static const Rolls made = rolls(2e6, 4);
  return made;
}

fem::ContactPair mirrored(const Rolls &r)
{
  return fem::make_pair("upper", r.backup_roll.roll, fem::held_by_mirror(r.backup_roll.roll), r.work_roll.roll,
                        fem::held_by_mirror(r.work_roll.roll), Eigen::VectorXd::Zero(r.work_roll.roll.grid.n_z));
}

fem::ContactPair in_stand(const Rolls &r, const double strip)
{
  return fem::make_pair("upper", r.backup_roll.roll, fem::held_by_necks(r.backup_roll.roll), r.work_roll.roll,
                        fem::held_by_strip(r.work_roll.roll, strip),
                        Eigen::VectorXd::Zero(r.work_roll.roll.grid.n_z));
}
}  // namespace

TEST(RollPairLong, MirroredApproachLiesInTheBandOfTheClosedForms)
{
  const auto pair = mirrored(shared_rolls());
  for (const double F : {F1, F2}) {
    const auto exact = closed_form::line_contact(F / 1.4, 0.420, 1.450, 210e9, 0.28);
    const auto state = fem::solve_load(pair, F);
    // Free ends make the real pair softer than the infinitely long one, never stiffer; end zones are a few
    // percent.
    EXPECT_GT(state.approach, exact.approach);
    EXPECT_TRUE(near(state.approach, exact.approach,
                     within(0.03, "two free ends of about one work-roll radius, 1400 mm long")));
    EXPECT_TRUE(
        near(state.tangent, 1.4 * exact.tangent, within(0.05, "datum and ends are not in the closed form")));
  }
}

TEST(RollPair, TangentGrowsWithTheLogarithmOfTheLoad)
{
  // Half as long: half the unknowns, and the datum and the ends count the same at every load.
  const double length = 0.7;
  const auto halved   = [](RollGeometry roll) {
    roll.half_length /= 2;
    roll.seat_centre -= roll.half_length;
    return roll;
  };
  const auto size = meshes::roll_contact_size(half_width(15e6), 6);
  const Rolls r{meshed_roll("backup", halved(backup), size, steel),
                meshed_roll("work", halved(work), size, steel)};
  const auto curve = fem::sweep(mirrored(r), fem::log_spaced(0.35e6, 7.5e6, 20));
  // Slope of approach over load between neighbouring loads: free of the steps of one active set.
  const auto tangent = [&](const int i) {
    return (curve.load[i + 2] - curve.load[i - 2]) / (curve.approach[i + 2] - curve.approach[i - 2]);
  };
  const auto exact = [&](const double F) {
    return closed_form::line_contact(F / length, 0.420, 1.450, 210e9, 0.28);
  };
  const auto reference = [&](const int i) {
    return (curve.load[i + 2] - curve.load[i - 2]) /
           (exact(curve.load[i + 2]).approach - exact(curve.load[i - 2]).approach);
  };
  EXPECT_TRUE(near(tangent(17) / tangent(2), reference(17) / reference(2),
                   within(0.02, "the datum cancels; end effects in part")));
}

TEST(RollPair, ForceBalancesAndLineLoadSumsUp)
{
  const auto &r = shared_rolls();
  for (const auto &pair : {mirrored(r), in_stand(r, 1.0), in_stand(r, 1.4)}) {
    const auto result  = fem::solve_load(pair, F1);
    const auto profile = fem::barrel_profile(pair, result);
    const auto w       = fem::axial_weights(profile.z, 0.7, 2);
    EXPECT_TRUE(near(2 * w.dot(profile.line_load), F1, within(1e-10, "equilibrium")));
    EXPECT_LE(result.state.residual, 1e-12);
    const auto above = fem::solve_load(pair, F1 * (1 + 1e-7), result.state.active);
    const auto below = fem::solve_load(pair, F1 * (1 - 1e-7), result.state.active);
    EXPECT_TRUE(near(result.tangent, 2e-7 * F1 / (above.approach - below.approach),
                     within(1e-6, "linear inside one active set")));
  }
}

TEST(RollPair, NarrowStripConcentratesTheLoadAndBendingShowsOnTheAxis)
{
  const auto &r   = shared_rolls();
  const auto wide = in_stand(r, 1.4), narrow = in_stand(r, 0.6);
  const auto q_wide   = fem::barrel_profile(wide, fem::solve_load(wide, F1));
  const auto q_narrow = fem::barrel_profile(narrow, fem::solve_load(narrow, F1));
  EXPECT_GT(q_narrow.line_load[0], 1.2 * q_wide.line_load[0]);
  EXPECT_GT(q_narrow.approach[0], q_narrow.approach[q_narrow.approach.size() - 1]);
}

TEST(RollPair, BackupRollBendsLikeAStepBeam)
{
  // Axis deflection between bearing centre and mid-length under the mirrored load distribution, against
  // Timoshenko theory with the same uniform load: bending and shear of a roll as thick as it is long.
  const auto &roll        = shared_rolls().backup_roll.roll;
  const auto held         = fem::held_by_necks(roll);
  Eigen::VectorXd uniform = roll.grid.area / roll.grid.area.sum();
  const Eigen::VectorXd v = held.axis * uniform + held.axis_support;  // m per N on a quarter
  int centre              = 0;
  for (int k = 0; k < roll.axis_z.size(); ++k)
    if (std::abs(roll.axis_z[k] - 1.225) < std::abs(roll.axis_z[centre] - 1.225))
      centre = k;
  const double drop = (v[0] - v[centre]) / 4;  // per N on the whole roll
  EXPECT_TRUE(near(
      std::abs(drop), 1 / 6.8123e10,
      within(0.10, "a beam of length/height about 1 is good to a tenth; K_ZW of the stepped Timoshenko beam")));
}

TEST(RollPair, CrownOpensTheEndsAndAMachinedHollowTheMiddle)
{
  const auto &r     = shared_rolls();
  const auto gap_of = [&](const double crown) {
    const Eigen::VectorXd z = r.work_roll.roll.grid.z;
    return Eigen::VectorXd(0.5 * crown * (z / 0.7).array().square());
  };
  const auto pair = [&](const double crown) {
    return fem::make_pair("upper", r.backup_roll.roll, fem::held_by_mirror(r.backup_roll.roll), r.work_roll.roll,
                          fem::held_by_mirror(r.work_roll.roll), gap_of(crown));
  };
  const auto flat = fem::barrel_profile(pair(0), fem::solve_load(pair(0), F1));
  const auto high = fem::barrel_profile(pair(40e-6), fem::solve_load(pair(40e-6), F1));
  const auto deep = fem::barrel_profile(pair(-20e-6), fem::solve_load(pair(-20e-6), F1));
  EXPECT_GT(high.line_load[0], 1.15 * flat.line_load[0]);
  EXPECT_LT(deep.line_load[0], flat.line_load[0]);
  // A crown that the load cannot close leaves the ends free.
  const auto round = fem::barrel_profile(pair(400e-6), fem::solve_load(pair(400e-6), F2));
  EXPECT_EQ(round.line_load[round.line_load.size() - 1], 0);
}
