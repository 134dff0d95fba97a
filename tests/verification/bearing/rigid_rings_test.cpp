#include "core/base/errors.h"
#include "reduce/bearing/rigid_rings.h"
#include "tests/support/demo_bearing.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include <cmath>

using namespace mill;
using namespace mill::bearing;

namespace {
constexpr double degree = M_PI / 180;

RollerBearing tapered(const OneRollerLaw law, const double cup_angle_deg, const double clearance = 0)
{
  RollerBearing b    = demo_bearing(cup_angle_deg);
  b.radial_clearance = clearance;
  b.roller_law       = law;
  return b;
}

RollerBearing crowned(const int slices)
{
  RollerBearing b = tapered(OneRollerLaw::iso, 20);
  b.profile       = RollerProfile::iso;
  b.slices        = slices;
  return b;
}
}  // namespace

// Reference: Palmgren law, cup angle 19.66 deg; its clearance is measured normal to the raceway, the case's
// radially.
TEST(BearingStiffness, MeetsTheReferenceTable)
{
  const auto root = within(1e-9, "root found to rounding, closed-form law");
  for (const auto &row : reference("bearing.stiffness")) {
    const double clearance   = double(row[0]) / std::cos(19.66 * degree);
    const BearingState state = solve_bearing(tapered(OneRollerLaw::palmgren, 19.66, clearance), row[1]);
    EXPECT_TRUE(near(state.displacement, row[2], root));
    EXPECT_TRUE(near(state.secant, row[3], root));
    EXPECT_TRUE(near(
        state.tangent, row[4],
        within(1e-8, "slope of a roller just in contact goes with d^(1/9): it magnifies the last digits of d")));
    EXPECT_TRUE(near(state.roller_max, row[5], root));
    for (int r = 0; r < 4; ++r)
      EXPECT_EQ(state.loaded_rollers[r], int(row[6]));
  }
}

TEST(BearingStiffness, StribeckNumberAndPowerLawWithoutClearance)
{
  for (const double load : {1e3, 488e3, 5e6}) {
    const BearingState state = solve_bearing(tapered(OneRollerLaw::iso, 19.66), load);
    EXPECT_TRUE(near(state.roller_max * 4 * 39 * std::cos(19.66 * degree) / load, 4.0847,
                     within_absolute(1e-4, "printed with five digits; Stribeck's own 4.08")));
    EXPECT_TRUE(near(state.tangent / state.secant, 10.0 / 9, within(1e-9, "power law without clearance")));
    EXPECT_TRUE(near(state.roller_tangent / state.roller_secant, 10.0 / 9, within(1e-12, "power law")));
    EXPECT_EQ(state.loaded_rollers[0], 19);
  }
}

// The published bearing stiffness 2.01e10 N/m is the sum of four one-roller stiffnesses times Z/5, that is
// Stribeck's factor raised from 4.08 to 5.  With the zero-clearance factor the same construction is exact for a
// power law: tangent of the bearing = rows x tangent of the heaviest roller x Z / 4.0847 x cos^2.
TEST(BearingStiffness, BearingIsTheRollerTimesRowsTimesStribeck)
{
  const BearingState state = solve_bearing(tapered(OneRollerLaw::palmgren, 19.66), 488e3);
  const double stribeck    = state.roller_max * 4 * 39 * std::cos(19.66 * degree) / state.load;
  const double cosine      = std::cos(19.66 * degree);
  EXPECT_TRUE(near(4 * state.roller_tangent * 39 / stribeck * cosine * cosine, state.tangent,
                   within(1e-12, "identity of the power law")));
  const double row_sum =
      (6.78395 + 6.37958 + 6.23286 + 6.47685) * 1e8;  // published rows; the third lost its exponent in print
  EXPECT_TRUE(
      near(row_sum * 39 / 5, reference("bearing.row_sum_times_Z_over_5"), within(1e-6, "published digits")));
  EXPECT_TRUE(near(row_sum * 39 / 5, 2.01e10, within(5e-3, "the published total has three digits")));
}

TEST(BearingStiffness, ReachesThePublishedTotalAtTheReferenceLoads)
{
  const auto load = reference("bearing.load_for_published_total");
  EXPECT_TRUE(near(solve_bearing(tapered(OneRollerLaw::palmgren, 19.66), load.at("tangent")).tangent, 2.01e10,
                   within(1e-9, "power law inverted")));
  EXPECT_TRUE(near(solve_bearing(tapered(OneRollerLaw::palmgren, 19.66), load.at("secant")).secant, 2.01e10,
                   within(1e-9, "power law inverted")));
}

// ISO law, 20 deg.  Columns: load kN; no clearance: secant, tangent N/mm, Qmax kN; 0.1 mm diametral clearance:
// secant, tangent, loaded rollers per row.
TEST(BearingStiffness, FourRowsByTheStandardsLaw)
{
  const double table[6][7] = {{100, 1.554e7, 1.727e7, 2.79, 1.615e6, 1.180e7, 7},
                              {250, 1.703e7, 1.893e7, 6.97, 3.457e6, 1.632e7, 11},
                              {500, 1.826e7, 2.029e7, 13.93, 5.770e6, 1.811e7, 11},
                              {1000, 1.957e7, 2.174e7, 27.86, 8.946e6, 2.067e7, 13},
                              {2000, 2.097e7, 2.330e7, 55.73, 1.274e7, 2.292e7, 15},
                              {4000, 2.248e7, 2.497e7, 111.5, 1.665e7, 2.489e7, 17}};
  const auto printed       = within(6e-4, "printed with four digits");
  for (const auto &row : table) {
    const BearingState tight = solve_bearing(tapered(OneRollerLaw::iso, 20), row[0] * 1e3);
    EXPECT_TRUE(near(tight.secant * 1e-3, row[1], printed));
    EXPECT_TRUE(near(tight.tangent * 1e-3, row[2], printed));
    EXPECT_TRUE(near(tight.roller_max * 1e-3, row[3], within(2e-3, "printed with three digits")));
    const BearingState loose = solve_bearing(tapered(OneRollerLaw::iso, 20, 1e-4), row[0] * 1e3);
    EXPECT_TRUE(near(loose.secant * 1e-3, row[4], printed));
    EXPECT_TRUE(near(loose.tangent * 1e-3, row[5], printed));
    EXPECT_EQ(loose.loaded_rollers[2], int(row[6]));
  }
}

// The standard's crown 0.00045 D_we ln(...): load kN, secant, tangent N/mm with 41 laminae.
TEST(BearingStiffness, FourRowsWithTheStandardsCrown)
{
  const double table[6][3] = {{100, 7.468e6, 1.154e7},  {250, 1.019e7, 1.517e7},  {500, 1.266e7, 1.795e7},
                              {1000, 1.536e7, 2.071e7}, {2000, 1.814e7, 2.312e7}, {4000, 2.071e7, 2.493e7}};
  const auto printed       = within(6e-4, "printed with four digits");
  for (const auto &row : table) {
    const BearingState state = solve_bearing(crowned(41), row[0] * 1e3);
    EXPECT_TRUE(near(state.secant * 1e-3, row[1], printed));
    EXPECT_TRUE(near(state.tangent * 1e-3, row[2], printed));
  }
  EXPECT_TRUE(near(solve_bearing(crowned(31), 1e6).tangent * 1e-3, 2.096e7, printed));
  EXPECT_TRUE(near(solve_bearing(crowned(101), 1e6).tangent * 1e-3, 2.078e7, printed));
}

TEST(BearingStiffness, InterferenceLoadsMoreRollers)
{
  const BearingState light = solve_bearing(tapered(OneRollerLaw::iso, 20, -20e-6), 1e6),
                     heavy = solve_bearing(tapered(OneRollerLaw::iso, 20, -50e-6), 1e6);
  EXPECT_TRUE(near(light.secant * 1e-3, 2.59e7, within(3e-3, "printed with three digits")));
  EXPECT_TRUE(near(heavy.secant * 1e-3, 4.03e7, within(3e-3, "printed with three digits")));
  EXPECT_EQ(light.loaded_rollers[0], 23);
  EXPECT_EQ(heavy.loaded_rollers[0], 39);
}

TEST(BearingStiffness, TiltMovesLoadBetweenRows)
{
  const double share[3][6] = {{1e6, 0.1e-3, 17.3, 26.5, 23.4, 32.8},
                              {1e6, 0.5e-3, -10.7, 30.8, 15.8, 64.1},
                              {500e3, 0.5e-3, -45.7, 36.4, 8.7, 100.6}};
  for (const auto &row : share) {
    const BearingState state = solve_bearing(tapered(OneRollerLaw::iso, 20), row[0], row[1]);
    for (int r = 0; r < 4; ++r)
      EXPECT_TRUE(near(
          state.row_share[r] * 100, row[2 + r],
          within_absolute(
              0.5, "printed to 0.1; laminae, which the print may lack, change 0.1 and more at half the load")));
    EXPECT_TRUE(near(state.row_share.sum(), 1, within(1e-12, "shares of one load")));
  }
  // 22.1075 and 19.5678 kN/um by a bisection of (5.11) to (5.13) in another language, 41 laminae and one.
  EXPECT_TRUE(
      near(solve_bearing(tapered(OneRollerLaw::iso, 20), 1e6, 1e-3).secant, 22.1075e9, within(1e-5, "printed")));
  EXPECT_TRUE(near(solve_bearing(tapered(OneRollerLaw::iso, 20), 1e6).secant, 19.5678e9, within(1e-5, "printed")));
  const BearingState level = solve_bearing(tapered(OneRollerLaw::iso, 20), 1e6);
  for (int r = 0; r < 4; ++r)
    EXPECT_TRUE(near(level.row_share[r], 0.25, within(1e-12, "four equal rows")));
}

// cos(90 deg) is 6e-17: a roller there is pressed by rounding, and carries nothing.  40 rollers of a row have 19
// between -81 and 81 deg.
TEST(BearingStiffness, ARollerAtRightAnglesDoesNotCount)
{
  RollerBearing b   = tapered(OneRollerLaw::iso, 20);
  b.rollers_per_row = 40;
  EXPECT_EQ(solve_bearing(b, 1e6).loaded_rollers[0], 19);
}

// All rows of one hand: the tilted rims press all of them to one side, and the ring settles on the other.
TEST(BearingStiffness, RowsOfOneHandBalanceUnderTilt)
{
  RollerBearing b = tapered(OneRollerLaw::iso, 20);
  b.arrangement   = "+";
  for (const double tilt : {0.5e-3, -0.5e-3}) {
    const BearingState state = solve_bearing(b, 1e5, tilt);
    EXPECT_TRUE(near(state.row_share.sum(), 1, within(1e-9, "equilibrium")));
    EXPECT_EQ(state.displacement > 0, tilt > 0) << "R tan(alpha) theta is 28 um, the load's own travel 6 um";
  }
}

// d F / d displacement against the curve itself, in every kind of state.
TEST(BearingStiffness, TangentIsTheSlopeOfTheCurve)
{
  RollerBearing log_profile = tapered(OneRollerLaw::palmgren, 19.66, 50e-6);
  log_profile.profile       = RollerProfile::log;
  for (const RollerBearing &bearing :
       {tapered(OneRollerLaw::palmgren, 19.66), tapered(OneRollerLaw::iso, 20, 1e-4),
        tapered(OneRollerLaw::iso, 20, -50e-6), crowned(41), log_profile})
    for (const double tilt : {0.0, 0.3e-3}) {
      const double load = 300e3, step = 1e-4 * load;
      const double slope = 2 * step /
                           (solve_bearing(bearing, load + step, tilt).displacement -
                            solve_bearing(bearing, load - step, tilt).displacement);
      EXPECT_TRUE(
          near(solve_bearing(bearing, load, tilt).tangent, slope,
               within(5e-4, "a lamina that comes into contact inside the step bends the curve like d^(1/9)")));
    }
  const double load = 300e3, step = 1e-4 * load;
  const auto value_at = [&](double F) {
    return solve_bearing(tapered(OneRollerLaw::palmgren, 19.66), F).displacement;
  };
  EXPECT_TRUE(near(solve_bearing(tapered(OneRollerLaw::palmgren, 19.66), load).tangent,
                   2 * step / (value_at(load + step) - value_at(load - step)),
                   within(1e-6, "no roller changes its state: central difference, truncation 1e-9")));
}

TEST(BearingStiffness, EquilibriumAndCurve)
{
  for (const double load : {100e3, 1e6, 4e6}) {
    const BearingState state = solve_bearing(tapered(OneRollerLaw::iso, 20, 1e-4), load);
    double force = 0, across = 0;
    for (int r = 0; r < 4; ++r)
      for (int j = 0; j < 39; ++j) {
        force += state.roller_load(r, j) * std::cos(20 * degree) * std::cos(state.azimuth[j]);
        across += state.roller_load(r, j) * std::cos(20 * degree) * std::sin(state.azimuth[j]);
      }
    EXPECT_TRUE(near(force, state.load, within(1e-12, "equilibrium to rounding")));
    EXPECT_TRUE(near(across, 0, within(1e-12, "symmetric about the load line", state.load)));
  }
}

TEST(BearingStiffness, SmallAndLargeLoadsConverge)
{
  for (const double load : {1e-3, 1.0, 1e9}) {
    EXPECT_TRUE(near(solve_bearing(tapered(OneRollerLaw::iso, 20, 1e-3), load).load, load,
                     within(1e-15, "returned as given")));
    EXPECT_GT(solve_bearing(crowned(41), load).tangent, 0);
  }
}

TEST(BearingStiffness, RefusesInWords)
{
  try {
    solve_bearing(tapered(OneRollerLaw::iso, 20, 1e-4), 0);
    FAIL() << "accepted";
  } catch (const InputError &error) {
    EXPECT_STREQ(error.problems.at(0).message.c_str(),
                 "bearing.trb: radial load 0 kN; with a clearance of 100 um no roller is loaded "
                 "without load, so a stiffness does not exist");
  }
  EXPECT_THROW(solve_bearing(tapered(OneRollerLaw::iso, 20), -1e3), InputError);
  EXPECT_THROW(solve_bearing(tapered(OneRollerLaw::iso, 13.5), 1e5), InputError);
  RollerBearing narrow = tapered(OneRollerLaw::iso, 20);
  narrow.width         = not_given;
  EXPECT_NO_THROW(solve_bearing(narrow, 1e5));
  EXPECT_THROW(solve_bearing(narrow, 1e5, 1e-3), InputError);
  RollerBearing plain     = tapered(OneRollerLaw::iso, 20);
  plain.bore              = not_given;
  plain.roller_cone_angle = 0;
  EXPECT_THROW(solve_bearing(plain, 1e5, 1e-3), InputError) << "no pitch diameter, no place of the rim";
}
