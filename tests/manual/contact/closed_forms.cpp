#include "core/model/case.h"
#include "fem/contact/hertz.h"
#include "reduce/chain/line_contact.h"
#include "tests/manual/check/units.h"
#include "tests/manual/check/verification.h"
#include <array>
#include <cmath>

namespace mill::verify {
namespace {
using namespace contact;

const char *const printed_digits = "one unit of the last digit the reference is printed with: both sides are "
                                   "closed forms, so nothing but rounding may differ";

// A result against a printed number: equal up to one unit of its last digit.
Check printed(const std::string &quantity, const std::string &unit, const double result, const double reference,
              const double last_digit)
{
  return {quantity, unit, result, reference, last_digit, Judged::absolute};
}

Check identity(const std::string &quantity, const double result, const double reference, const double tolerance)
{
  return {quantity, "-", result, reference, tolerance};
}

std::vector<Check> love_patch()
{
  const HalfSpaces bodies = half_spaces(steel, rigid_material());
  const Rectangle square{1 * mm, 1 * mm};
  const double p      = 100 * MPa;
  const double centre = p * rectangle_influence(bodies, square, 0, 0)(2, 2);
  const double corner = p * rectangle_influence(bodies, square, 1 * mm, 1 * mm)(2, 2);
  // A thousand half sides away the square is a point force with a quadrupole of relative size (1 mm)^2 / (6 x^2).
  const double x = 1000 * mm, force = p * 4 * mm * mm;
  const double quadrupole = 1 + mm * mm / (6 * x * x);
  const double far =
      p * rectangle_influence(bodies, square, x, 0)(2, 2) / (force * point_influence(bodies, x, 0)(2, 2));
  return {printed("displacement of the centre", "um", centre / um, 0.972573, 1e-6),
          printed("displacement of a corner", "um", corner / um, 0.486287, 1e-6),
          identity("centre / corner", centre / corner, 2, 1e-12),
          identity("1000 half sides away / point force", far, quadrupole, 1e-12)};
}

std::vector<Check> hertz_forms()
{
  const double E      = contact_modulus(half_spaces(steel, steel));
  const Material soft = {20e9, 0.3, 0};
  const double E_soft = contact_modulus(half_spaces(soft, soft));
  const auto large    = hertz_point_at(4 * mm, 25 * mm, 25 * mm, E_soft);
  const auto small    = hertz_point_at(0.04 * mm, 25 * mm, 25 * mm, E_soft);
  const auto H2       = hertz_point(1000, 10 * mm, 10 * mm, E);
  const auto H3       = hertz_point(1000, 10 * mm, 20 * mm, E);
  const auto H6       = hertz_point(1e5, 152.941 * mm, 2.45e6 * mm, E);
  // The ellipse with radii that differ in the twelfth digit against the closed form of the sphere.
  const auto nearly   = hertz_point(1000, 10 * mm, 10 * mm * (1 + 1e-12), E);
  const double sphere = std::cbrt(3 * 1000 * 10 * mm / (4 * E));
  return {
      printed("H1, crush 4 mm: radius", "mm", large.semi_x / mm, 10, 1e-4),
      printed("H1, crush 4 mm: peak pressure", "MPa", large.peak_pressure / MPa, 2798.33, 1e-2),
      printed("H1, crush 0.04 mm: radius", "mm", small.semi_x / mm, 1, 1e-4),
      printed("H1, crush 0.04 mm: peak pressure", "MPa", small.peak_pressure / MPa, 279.833, 1e-3),
      printed("H2: radius", "mm", H2.semi_x / mm, 0.402073, 1e-6),
      printed("H2: peak pressure", "MPa", H2.peak_pressure / MPa, 2953.469, 1e-3),
      printed("H2: approach", "um", H2.approach / um, 16.1662, 1e-4),
      printed("H2: tangent", "N/mm", H2.tangent / N_per_mm, 92786, 1),
      printed("H3: larger semi-axis", "mm", H3.semi_y / mm, 0.564600, 1e-6),
      printed("H3: smaller semi-axis", "mm", H3.semi_x / mm, 0.356034, 1e-6),
      printed("H3: peak pressure", "MPa", H3.peak_pressure / MPa, 2375.252, 1e-3),
      printed("H3: approach", "um", H3.approach / um, 14.3073, 1e-4),
      printed("H3: tangent", "kN/mm", H3.tangent / kN_per_mm, 104.841, 1e-3),
      printed("H6: larger semi-axis", "mm", H6.semi_y / mm, 231.693, 1e-3),
      printed("H6: smaller semi-axis", "mm", H6.semi_x / mm, 0.739114, 1e-6),
      printed("H6: peak pressure", "MPa", H6.peak_pressure / MPa, 278.816, 1e-3),
      printed("H6: approach", "um", H6.approach / um, 12.7414, 1e-4),
      printed("H6: tangent", "kN/mm", H6.tangent / kN_per_mm, 11772.7, 0.1),
      identity("equal radii: radius / that of the sphere", H2.semi_x / sphere, 1, 1e-14),
      identity("equal radii: approach / (radius^2 / R)", H2.approach / (sphere * sphere / (10 * mm)), 1, 1e-14),
      identity("equal radii: tangent / (2 E* radius)", H2.tangent / (2 * E * sphere), 1, 1e-14),
      identity("radii equal to 1e-12: larger semi-axis / sphere", nearly.semi_y / sphere, 1, 2e-12)};
}

void add_cylinders(std::vector<Check> &checks, const std::string &name, const reduce::CylinderPair &pair,
                   const double q, const std::array<double, 5> &reference)
{
  // One metre of contact line: line loads and line stiffnesses are read as they are.
  const auto c      = reduce::line_contact(pair, q * pair.length);
  const auto secant = reduce::secant_laws(pair, q * pair.length);
  checks.push_back(printed(name + ": half width", "mm", c.half_width / mm, reference[0], 1e-4));
  checks.push_back(printed(name + ": peak pressure", "MPa", c.peak_pressure / MPa, reference[1], 1e-2));
  checks.push_back(printed(name + ": approach, Johnson", "um", c.approach / um, reference[2], 1e-3));
  checks.push_back(
      printed(name + ": approach, Foeppl", "um", q * pair.length / secant.foeppl / um, reference[3], 1e-3));
  checks.push_back(printed(name + ": dq/d(approach)", "N/mm2", c.tangent / pair.length / MPa, reference[4], 1));
}

// A disc squeezed between rigid plates: twice the approach of one contact to its axis.
void add_disc(std::vector<Check> &checks, const std::string &name, const double R, const double q,
              const std::array<double, 3> &reference)
{
  const auto c = hertz_line(q, R, contact_modulus(half_spaces(steel, rigid_material())));
  checks.push_back(printed(name + ": half width", "mm", c.half_width / mm, reference[0], 1e-6));
  checks.push_back(printed(name + ": peak pressure", "MPa", c.peak_pressure / MPa, reference[1], 1e-3));
  checks.push_back(printed(name + ": compression", "um", 2 * cylinder_approach(q, R, c.half_width, steel) / um,
                           reference[2], 1e-4));
}

void add_palmgren(std::vector<Check> &checks, const std::string &name, const double Q, const double length,
                  const double approach, const double tangent)
{
  // Diameters and material do not enter Palmgren's fit; the exponent 0.9 makes the slope the secant / 0.9.
  const double secant = reduce::secant_laws({20 * mm, 20 * mm, length, steel}, Q).palmgren;
  checks.push_back(printed(name + ": approach", "um", Q / secant / um, approach, 1e-3));
  checks.push_back(printed(name + ": tangent", "N/mm", secant / 0.9 / N_per_mm, tangent, 100));
}

std::vector<Check> line_forms()
{
  std::vector<Check> checks;
  const reduce::CylinderPair demo{400 * mm, 1300 * mm, 1, steel};
  const reduce::CylinderPair published{420 * mm, 1450 * mm, 1, {210e9, 0.28, 7700}};
  add_cylinders(checks, "200/650, 200 N/mm", demo, 200e3, {0.5810, 219.16, 8.074, 8.229, 26587});
  add_cylinders(checks, "200/650, 1000 N/mm", demo, 1000e3, {1.2991, 490.05, 35.931, 36.704, 30146});
  add_cylinders(checks, "200/650, 5000 N/mm", demo, 5000e3, {2.9049, 1095.78, 157.453, 161.321, 34804});
  add_cylinders(checks, "210/725, 697.29 N/mm, nu 0.28", published, 697.29e3,
                {1.1264, 394.08, 26.237, 26.783, 28708});
  add_disc(checks, "disc R 10, 500 N/mm", 10 * mm, 500e3, {0.166093, 1916.457, 13.7495});
  add_disc(checks, "disc R 50, 1000 N/mm", 50 * mm, 1000e3, {0.525232, 1212.074, 30.0268});
  add_palmgren(checks, "Palmgren, 10 kN, 30 mm", 10e3, 30 * mm, 10.061, 1.1044e6);
  add_palmgren(checks, "Palmgren, 20 kN, 40 mm", 20e3, 40 * mm, 14.915, 1.4900e6);
  add_palmgren(checks, "Palmgren, 50 kN, 60 mm", 50e3, 60 * mm, 24.597, 2.2586e6);
  return checks;
}

std::vector<Check> slip_forms()
{
  const HalfSpaces bodies = half_spaces(steel, steel);
  const double E = contact_modulus(bodies), mu = 0.3;
  std::vector<Check> checks;
  const auto line   = hertz_line(1000e3, 50 * mm, E);
  const auto sphere = hertz_point(1000, 10 * mm, 10 * mm, E);
  checks.push_back(printed("line: half width", "mm", line.half_width / mm, 0.742790, 1e-6));
  checks.push_back(printed("line: peak pressure", "MPa", line.peak_pressure / MPa, 857.066, 1e-3));
  // load ratio; line: c/b, traction in the middle and at the rim of stick; sphere: c/a, approach
  const double references[2][6] = {{0.25, 0.866025, 34.448, 128.560, 0.908560, 1.02776},
                                   {0.5, 0.707107, 75.309, 181.811, 0.793701, 2.17921}};
  for (const auto &r : references) {
    const std::string where = r[0] == 0.25 ? "Q/(mu P) 0.25, " : "Q/(mu P) 0.5, ";
    const auto slip         = cattaneo_line(line, r[0]);
    const auto ball         = mindlin_sphere(sphere, bodies, mu, r[0]);
    const double middle     = cattaneo_traction(line, slip, mu, 0);
    const double rim        = cattaneo_traction(line, slip, mu, slip.stick);
    checks.push_back(printed(where + "line: c/b", "-", slip.stick / line.half_width, r[1], 1e-6));
    checks.push_back(printed(where + "line: traction at 0", "MPa", middle / MPa, r[2], 1e-3));
    checks.push_back(printed(where + "line: traction at c", "MPa", rim / MPa, r[3], 1e-3));
    checks.push_back(printed(where + "sphere: c/a", "-", ball.stick / sphere.semi_x, r[4], 1e-6));
    checks.push_back(printed(where + "sphere: tangential approach", "um", ball.tangential / um, r[5], 1e-5));
  }
  const double k = mindlin_sphere(sphere, bodies, mu, 0).stiffness;
  checks.push_back(printed("sphere: initial tangential stiffness", "N/mm", k / N_per_mm, 76412, 1));
  checks.push_back(
      identity("sphere: initial stiffness, tangential / normal", k / sphere.tangent, 1.4 / 1.7, 1e-12));
  return checks;
}

std::vector<Check> punch_forms()
{
  const double E   = contact_modulus(half_spaces(steel, rigid_material()));
  const auto punch = circular_punch(10e3, 10 * mm, E);
  return {
      printed("approach", "um", punch.approach / um, 2.166667, 1e-6),
      printed("stiffness", "N/mm", punch.stiffness / N_per_mm, 4615384.6, 0.1),
      printed("pressure in the middle", "MPa", circular_punch_pressure(10e3, 10 * mm, 0) / MPa, 15.91549, 1e-5)};
}
}  // namespace

std::vector<Case> closed_forms()
{
  std::vector<Case> cases;
  cases.push_back(
      {"love-patch", "unit",
       "Steel half space under 100 MPa on a square of 2 mm x 2 mm: Love's closed form of the normal displacement, "
       "and Gauss points where that form would lose digits far from the square.",
       "A. E. H. Love, Phil. Trans. A 228 (1929) 377, evaluated for these numbers; the ratio 2 follows from the "
       "symmetry of the square",
       std::string(printed_digits) +
           "; ratios without reference to printed numbers to 1e-12, the round-off of some tens of operations",
       love_patch});
  cases.push_back(
      {"hertz-forms", "unit",
       "Closed forms of point contacts: two spheres (H1), sphere on flat (H2), ellipse of radii 10 and 20 mm "
       "(H3), crowned roll pair with an axis ratio of 313 (H6), equal radii. Complete elliptic integrals by the "
       "arithmetic-geometric mean.",
       "K. L. Johnson, Contact Mechanics (1985), 4.2, evaluated for these numbers",
       std::string(printed_digits) +
           " (H3: the larger semi-axis is 0.5645994); identities to 1e-14, the round-off of a cube root",
       hertz_forms});
  cases.push_back({"line-forms", "unit",
                   "Closed forms of line contacts: two steel cylinders by Johnson and by Foeppl, discs between "
                   "rigid plates, Palmgren's law of one roller contact.",
                   "K. L. Johnson, Contact Mechanics (1985), eq. 4.42 to 4.45 and 5.57; A. Foeppl's and G. "
                   "Palmgren's formulas; evaluated for these numbers",
                   printed_digits, line_forms});
  cases.push_back({"slip-forms", "unit",
                   "Closed forms of partial slip, friction coefficient 0.3: cylinder R 50 on flat under 1000 N/mm "
                   "(Cattaneo) and sphere R 10 on flat under 1000 N (Mindlin), steel on steel.",
                   "R. D. Mindlin, J. Appl. Mech. 16 (1949) 259; K. L. Johnson, Contact Mechanics (1985), 7.2",
                   std::string(printed_digits) + "; the ratio 2 (1 - nu) / (2 - nu) to 1e-12", slip_forms});
  cases.push_back({"punch-forms", "unit",
                   "Closed form of a rigid circular flat punch of radius 10 mm on steel under 10 kN.",
                   "K. L. Johnson, Contact Mechanics (1985), 3.4 and 5.3", printed_digits, punch_forms});
  return cases;
}
}  // namespace mill::verify
