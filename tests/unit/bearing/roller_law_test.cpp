#include "core/base/errors.h"
#include "reduce/bearing/roller_law.h"
#include "tests/support/demo_bearing.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include <cmath>

using namespace mill;
using namespace mill::bearing;

namespace {
constexpr double per_mm = 2154.4346900318843;  // 1000^(10/9): N/mm^(10/9) in N/m^(10/9)

RollerBearing bearing_with(const OneRollerLaw law, const RollerProfile profile = RollerProfile::none)
{
  RollerBearing b = demo_bearing();
  b.roller_law    = law;
  b.profile       = profile;
  return b;
}
}  // namespace

// ISO/TS 16281 (35): 35948 l^(8/9); values of the constant and of the approach at 10 kN from the standard's
// formula.
TEST(RollerLaw, IsoConstantAndApproach)
{
  EXPECT_TRUE(
      near(roller_constant(OneRollerLaw::iso, 0.0334), 813048 * per_mm, within(1e-6, "printed with six digits")));
  EXPECT_TRUE(
      near(roller_constant(OneRollerLaw::iso, 0.010), 278332 * per_mm, within(2e-6, "printed with six digits")));
  EXPECT_TRUE(near(roller_approach(roller_law(bearing_with(OneRollerLaw::iso)), 10e3), 19.094e-6,
                   within(1e-4, "printed with five digits")));
}

// 3.84e-5 Q^0.9 / l^0.8 belongs to one contact; read as the whole roller the stiffness doubles.
TEST(RollerLaw, PalmgrenApproachIncludesBothContacts)
{
  EXPECT_TRUE(near(roller_constant(OneRollerLaw::palmgren, 0.0334), reference("bearing.Kn"),
                   within(1e-12, "same closed form")));
  EXPECT_TRUE(near(roller_approach(roller_law(bearing_with(OneRollerLaw::palmgren)), 10e3), 18.466e-6,
                   within(1e-4, "printed with five digits")));
  const RollerLaw law = roller_law(bearing_with(OneRollerLaw::palmgren));
  for (const auto &row : reference("bearing.one_roller")) {
    const double load = row[0], d = roller_approach(law, load);
    EXPECT_TRUE(near(d, row[1], within(1e-12, "closed form inverted by Newton to rounding")));
    EXPECT_TRUE(near(load / d, row[2], within(1e-12, "as above")));
    EXPECT_TRUE(near(roller_load(law, d, 0).stiffness, row[3], within(1e-12, "as above")));
  }
}

TEST(RollerLaw, SumOverLaminaeIsTheWholeRoller)
{
  for (const int n : {1, 31, 41, 101}) {
    RollerBearing b = bearing_with(OneRollerLaw::iso);
    b.slices        = n;
    EXPECT_TRUE(near(roller_load(roller_law(b), 20e-6, 0).load,
                     roller_constant(OneRollerLaw::iso, 0.0334) * std::pow(20e-6, 10.0 / 9),
                     within(1e-13, "equal laminae, rounding of the sum")));
  }
}

// Elastic half-planes (Johnson 1985, ch. 5), E 206 GPa, nu 0.3, raceways held 12 mm deep: columns load kN,
// approach um, roller part um, half widths mm, peak pressures MPa (inner, outer).
TEST(RollerLaw, ElasticRollerIsComparedWithTheStandard)
{
  const double table[6][7] = {
      {1, 2.00, 1.02, 0.058, 0.062, 328, 306},      {5, 8.62, 4.44, 0.130, 0.139, 734, 685},
      {10, 16.08, 8.29, 0.184, 0.197, 1038, 969},   {20, 29.82, 15.41, 0.260, 0.278, 1468, 1370},
      {50, 66.82, 34.66, 0.411, 0.440, 2322, 2166}, {100, 121.98, 63.49, 0.581, 0.622, 3283, 3064}};
  for (const auto &row : table) {
    const ElasticRoller roller = elastic_roller(bearing_with(OneRollerLaw::iso), row[0] * 1e3, 12e-3);
    EXPECT_TRUE(
        near(roller.approach * 1e6, row[1], within_absolute(0.0051, "half a unit of the last printed digit")));
    EXPECT_TRUE(
        near(roller.roller_part * 1e6, row[2], within_absolute(0.0051, "half a unit of the last printed digit")));
    EXPECT_TRUE(near(roller.inner_half_width * 1e3, row[3],
                     within_absolute(0.00051, "half a unit of the last printed digit")));
    EXPECT_TRUE(near(roller.outer_half_width * 1e3, row[4],
                     within_absolute(0.00051, "half a unit of the last printed digit")));
    EXPECT_TRUE(near(roller.inner_peak_pressure * 1e-6, row[5],
                     within_absolute(0.51, "half a unit of the last printed digit")));
    EXPECT_TRUE(near(roller.outer_peak_pressure * 1e-6, row[6],
                     within_absolute(0.51, "half a unit of the last printed digit")));
  }
}

// ISO/TS 16281 section 6, roller of 21.5 mm: 2.8 um at a quarter, 22 um at 0.95 of the half length (one contact).
TEST(RollerLaw, IsoProfileOfATaperedRoller)
{
  RollerBearing b = bearing_with(OneRollerLaw::iso, RollerProfile::iso);
  b.slices        = 2;  // middles at +- L/4
  EXPECT_TRUE(near(roller_law(b).drop[1] / 2, 0.00045 * 0.0215 * std::log(4.0 / 3),
                   within(1e-12, "the formula at 2x/L = 1/2")));
  EXPECT_TRUE(near(roller_law(b).drop[1] / 2 * 1e6, 2.8, within_absolute(0.05, "printed with one decimal")));
  b.slices = 20;  // last middle at 0.95 of the half length
  EXPECT_TRUE(
      near(roller_law(b).drop[19] / 2 * 1e6, 22,
           within_absolute(0.6, "the last slice has a middle near, not at the place of the printed value")));
}

TEST(RollerLaw, IsoProfileOfCylindricalRollers)
{
  RollerBearing b = bearing_with(OneRollerLaw::iso, RollerProfile::iso);
  b.type          = BearingType::four_row_cylindrical;
  b.slices        = 2;
  EXPECT_TRUE(near(roller_law(b).drop[1] / 2, 0.00035 * 0.0215 * std::log(4.0 / 3),
                   within(1e-12, "short roller, eq. (42)")));
  b.roller_length     = 4 * b.roller_diameter;  // flat over 1.5 D in the middle
  b.slices            = 8;                      // middles at 0.25, 0.75, 1.25, 1.75 D from the middle
  const RollerLaw law = roller_law(b);
  EXPECT_EQ(law.drop[4], 0);
  EXPECT_EQ(law.drop[5], 0);
  const double u = (2 * 1.75 - 1.5) / 2.5;
  EXPECT_TRUE(
      near(law.drop[7] / 2, 0.0005 * 0.0215 * -std::log(1 - u * u), within(1e-12, "long roller, eq. (44)")));
}

// The logarithmic profile is the one that keeps 2 GPa even over the length: away from the ends it is Lundberg's.
TEST(RollerLaw, LogProfileIsLundbergsAtTheDesignPressure)
{
  RollerBearing b = bearing_with(OneRollerLaw::iso, RollerProfile::log);
  b.slices        = 2;
  const double R = 1 / (2 / 0.0215 + 2 / (0.31115 - 0.0215)), E = 206e9, nu = 0.3, p0 = 2e9;
  const double q        = p0 * p0 * M_PI * R * 2 * (1 - nu * nu) / E;
  const double lundberg = 2 * q * (1 - nu * nu) / (M_PI * E) * std::log(4.0 / 3);
  const double measured = roller_law(b).drop[1] / 2;
  EXPECT_LT(measured, lundberg);  // Johns and Gohar round the ends off
  EXPECT_TRUE(near(measured, lundberg,
                   within(0.01, "Johns-Gohar factor 1 - 0.3033 b / (L/2) acts at second order of b/L")));
}

TEST(RollerLaw, CrownIsACircleAndTiltLoadsOneEnd)
{
  RollerBearing b = bearing_with(OneRollerLaw::iso, RollerProfile::crown);
  b.crown_drop    = 10e-6;
  b.slices        = 2;
  EXPECT_TRUE(near(roller_law(b).drop[1] / 2, 2.5e-6, within(1e-12, "a quarter of the end drop at half way")));

  const RollerLaw flat = roller_law(bearing_with(OneRollerLaw::iso));
  // All of the roller in contact and a small tilt: load is c_s sum (d + x t)^(10/9), second order in the tilt.
  const double d = 20e-6, tilt = 1e-4, L = 0.0334;
  const double second = roller_constant(OneRollerLaw::iso, L) * std::pow(d, 10.0 / 9) * 5.0 / 81 *
                        std::pow(tilt * L / d, 2) / 12 * (1 - 1.0 / (41 * 41));
  EXPECT_TRUE(near(roller_load(flat, d, tilt).load - roller_load(flat, d, 0).load, second,
                   within(1e-3, "next term of the series is of fourth order, (tilt L / 2d)^2 / 40 of this one")));
  EXPECT_TRUE(
      near(roller_load(flat, d, tilt).load, roller_load(flat, d, -tilt).load, within(1e-14, "symmetric roller")));
}

TEST(RollerLaw, RefusesUnknownLawsAndProfiles)
{
  EXPECT_THROW(roller_constant(OneRollerLaw::elastic, 0.03), InputError);
  EXPECT_THROW(roller_law(bearing_with(OneRollerLaw::iso, RollerProfile::crown)), InputError);
  RollerBearing b   = bearing_with(OneRollerLaw::iso, RollerProfile::iso);
  b.roller_diameter = not_given;
  EXPECT_THROW(roller_law(b), InputError);
  b        = bearing_with(OneRollerLaw::iso);
  b.slices = 0;
  EXPECT_THROW(roller_law(b), InputError);
  EXPECT_THROW(elastic_roller(bearing_with(OneRollerLaw::iso), 0, 12e-3), InputError);
}
