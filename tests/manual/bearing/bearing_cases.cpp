#include "reduce/bearing/geometry.h"
#include "reduce/bearing/ratings.h"
#include "tests/manual/bearing/bearing_models.h"
#include "tests/manual/check/units.h"
#include <cmath>
#include <fmt/format.h>
#include <utility>

// Roller bearings from the law of one roller: laws and formulas here, assembled bearings in assembly_cases.cpp.
namespace mill::verify {
namespace {
const double per_mm = std::pow(1e3, 10.0 / 9);  // N/mm^(10/9) in N/m^(10/9)

Check absolute(const std::string &quantity, const std::string &unit, double result, double reference,
               double tolerance)
{
  return {quantity, unit, result, reference, tolerance, Judged::absolute};
}

std::vector<Check> iso_roller()
{
  return {relative("constant c_L, 33.4 mm", "N/mm^(10/9)",
                   bearing::roller_constant(OneRollerLaw::iso, 33.4 * mm) / per_mm, 813048, 1e-4),
          relative("constant c_L, 10 mm", "N/mm^(10/9)",
                   bearing::roller_constant(OneRollerLaw::iso, 10 * mm) / per_mm, 278332, 1e-4),
          relative("approach at 10 kN", "um",
                   bearing::roller_approach(bearing::roller_law(bearing_266()), 10 * kN) / um, 19.094, 1e-4)};
}

std::vector<Check> palmgren_two()
{
  RollerBearing b = bearing_266();
  b.roller_law    = OneRollerLaw::palmgren;
  return {relative("approach at 10 kN, both contacts", "um",
                   bearing::roller_approach(bearing::roller_law(b), 10 * kN) / um, 18.466, 1e-4)};
}

std::vector<Check> elastic_roller_table()
{
  // load kN, approach um, roller part um, half widths mm, peak pressures MPa (inner, outer)
  const double table[6][7] = {
      {1, 2.00, 1.02, 0.058, 0.062, 328, 306},      {5, 8.62, 4.44, 0.130, 0.139, 734, 685},
      {10, 16.08, 8.29, 0.184, 0.197, 1038, 969},   {20, 29.82, 15.41, 0.260, 0.278, 1468, 1370},
      {50, 66.82, 34.66, 0.411, 0.440, 2322, 2166}, {100, 121.98, 63.49, 0.581, 0.622, 3283, 3064}};
  std::vector<Check> checks;
  const RollerBearing b        = bearing_266();
  const bearing::RollerLaw law = bearing::elastic_law(b, {12 * mm, 12 * mm});
  for (const auto &row : table) {
    const double Q   = row[0] * kN;
    const auto state = bearing::elastic_roller(b, Q, 12 * mm);
    const auto where = fmt::format(", {:g} kN", row[0]);
    checks.push_back(absolute("approach" + where, "um", state.approach / um, row[1], 0.0051));
    checks.push_back(absolute("of it in the roller" + where, "um", state.roller_part / um, row[2], 0.0051));
    checks.push_back(absolute("half width, inner" + where, "mm", state.inner_half_width / mm, row[3], 0.00051));
    checks.push_back(absolute("half width, outer" + where, "mm", state.outer_half_width / mm, row[4], 0.00051));
    checks.push_back(
        absolute("peak pressure, inner" + where, "MPa", state.inner_peak_pressure / MPa, row[5], 0.51));
    checks.push_back(
        absolute("peak pressure, outer" + where, "MPa", state.outer_peak_pressure / MPa, row[6], 0.51));
    checks.push_back(absolute("approach by 41 slices of the law" + where, "um",
                              bearing::roller_approach(law, Q) / um, row[1], 0.0051));
  }
  return checks;
}

std::vector<Check> apex_closure_table()
{
  // included cone deg, roller diameter mm, axis, cup, cone angle deg
  const double table[5][5] = {{2.5, 20, 19.84, 21.09, 18.59},
                              {2.5, 21.5, 18.41, 19.66, 17.16},
                              {2.5, 23, 17.17, 18.42, 15.92},
                              {1.25, 21.5, 9.08, 9.71, 8.46},
                              {5.0, 21.5, 39.19, 41.69, 36.69}};
  std::vector<Check> checks;
  for (const auto &row : table) {
    const auto closure = bearing::apex_closure(311.15 * mm, row[1] * mm, row[0] * degree, 39);
    const auto where   = fmt::format(", cone {:g} deg, roller {:g} mm", row[0], row[1]);
    checks.push_back(absolute("axis angle" + where, "deg", closure.axis_angle / degree, row[2], 0.01));
    checks.push_back(absolute("cup angle" + where, "deg", closure.cup_angle / degree, row[3], 0.01));
    checks.push_back(absolute("cone angle" + where, "deg", closure.cone_angle / degree, row[4], 0.01));
  }
  return checks;
}

std::vector<Check> fc_ratings()
{
  std::vector<Check> checks;
  const double factor[4] = {52.1, 60.8, 66.5, 70.7};
  for (int i = 0; i < 4; ++i) {
    const double g = 0.01 * (i + 1);
    checks.push_back(
        absolute(fmt::format("f_c at D cos a/D_pw = {:g}", g), "-", bearing::rating_factor(g), factor[i], 0.051));
  }
  // roller diameter mm, angle deg, C kN, C0 kN
  const double table[9][4] = {{20, 10, 1482, 4230},   {20, 13.5, 1464, 4180},   {20, 20, 1416, 4048},
                              {21.5, 10, 1624, 4524}, {21.5, 13.5, 1604, 4471}, {21.5, 20, 1552, 4331},
                              {23, 10, 1768, 4815},   {23, 13.5, 1747, 4759},   {23, 20, 1690, 4611}};
  for (const auto &row : table) {
    RollerBearing b   = bearing_266();
    b.roller_diameter = row[0] * mm;
    b.cup_angle       = row[1] * degree;
    const auto rating = bearing::ratings(b);
    const auto where  = fmt::format(", roller {:g} mm, {:g} deg", row[0], row[1]);
    checks.push_back(absolute("C" + where, "kN", rating.dynamic / kN, row[2], 0.51));
    checks.push_back(absolute("C_0" + where, "kN", rating.static_rating / kN, row[3], 0.51));
  }
  return checks;
}

std::vector<Check> friswell()
{
  const RollerBearing b = bearing_266();
  const auto state = bearing::BearingAssembly(bearing::rigid_model(b)).solve(bearing::radial_drive(1000 * kN));
  return {relative("formula, 1 MN", "kN/mm", bearing::friswell_stiffness(b, 1000 * kN) / kN_per_mm, 2.195e4, 5e-4),
          relative("tangent of the assembled bearing", "kN/mm",
                   bearing::radial_tangent(state, bearing::radial_drive(1000 * kN)) / kN_per_mm, 2.195e4, 0.02)};
}
}  // namespace

std::vector<Case> bearing_cases()
{
  std::vector<Case> cases;
  cases.push_back({"iso-roller", "unit",
                   "Constant and approach of one steel roller by ISO/TS 16281, both raceways.",
                   "c_L = 35948 L^(8/9) N/mm^(10/9), ISO/TS 16281:2008 (35), worked out for L = 33.4 and 10 mm",
                   "closed form, printed with six and five digits", iso_roller});
  cases.push_back(
      {"palmgren-two", "unit",
       "Approach of one roller of 33.4 mm at 10 kN by Palmgren's formula, which is for one contact; the "
       "roller has two.",
       "2 x 3.84e-5 Q^0.9 / L^0.8", "closed form, printed with five digits", palmgren_two});
  cases.push_back(
      {"elastic-roller", "unit",
       "Roller of 21.5 x 33.4 mm between a convex raceway of radius 144.8 and a concave one of 166.3 mm, "
       "both held 12 mm deep: plane strain elasticity, no empirical constant; and the same from the law "
       "of 41 slices that the assembled bearing uses, inverted by Newton's method.",
       "K. L. Johnson, Contact Mechanics (1985), chapter 5, E 206 GPa, nu 0.3",
       "half a unit of the last printed digit", elastic_roller_table});
  cases.push_back({"apex-closure", "unit",
                   "Angles with which roller, cup and cone share one apex, pitch diameter 311.15 mm.",
                   "sin(axis) = (D_pw/D_we) tan(beta)", "printed to 0.01 deg", apex_closure_table});
  cases.push_back({"fc-ratings", "unit",
                   "Factor f_c of ISO 281 for radial roller bearings, and ratings of the four-row bearing, 4 x 39 "
                   "rollers of 33.4 mm on 311.15 mm.",
                   "ISO 281 and ISO 76 formulas, tabulated", "half a unit of the last printed digit", fc_ratings});
  cases.push_back(
      {"friswell", "benchmark",
       "Radial tangent of the four-row bearing at 1 MN, cup angle 20 deg, rigid rings, no clearance: 4 x "
       "39 rollers of 41 slices by the ISO law, against a formula with one constant.",
       "M. I. Friswell et al., Dynamics of Rotating Machines (2010): 1e9 Z^0.9 L^0.8 F^0.1 cos^1.9(a)",
       "the formula itself to its four printed digits; 2 % between two roundings of the same empirical "
       "constant",
       friswell});
  for (Case &c : life_cases())
    cases.push_back(std::move(c));
  for (Case &c : assembly_cases())
    cases.push_back(std::move(c));
  return cases;
}
}  // namespace mill::verify
