#include "core/model/case.h"
#include "fem/contact/half_space_contact.h"
#include "fem/contact/hertz.h"
#include "tests/manual/check/units.h"
#include "tests/manual/check/verification.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

// Boundary elements on the half space: the operator, the active set and what is read off it, end to end.
namespace mill::verify {
namespace {
using namespace contact;

bool same_set(const HalfSpaceState &a, const HalfSpaceState &b)
{
  return ((a.pressure.array() > 0) == (b.pressure.array() > 0)).all();
}

// Slope of the curve by a central difference over the widest step in which no rectangle joins or leaves: the curve
// has a kink where one does.
double difference_tangent(HalfSpaceContact &contact, const double load)
{
  for (double step = 1e-4 * load;; step /= 10) {
    const HalfSpaceState below = contact.at_load(load - step), above = contact.at_load(load + step);
    if (same_set(below, above) || step < 1e-8 * load)
      return (above.load - below.load) / (above.approach - below.approach);
  }
}

// What every contact solution has to show: the contact conditions hold, and the tangent is that of the own curve.
void add_identities(std::vector<Check> &checks, HalfSpaceContact &contact, const double load)
{
  const HalfSpaceState s = contact.at_load(load);
  const double ratio     = s.set_tangent / difference_tangent(contact, load);
  checks.push_back(at_most("complementarity residual", "-", s.residual, 1e-12));
  checks.push_back(relative("tangent of the set / central difference", "-", ratio, 1, 1e-6));
}

// Paraboloid on a half space, cut into n_x by n_z rectangles that reach 1.15 semi-axes.
struct Paraboloid {
  HalfSpaces bodies;
  double load, radius_x, radius_z;
  int n_x, n_z;
};

GapShape gap_of(const Paraboloid &p)
{
  return [p](const double x, const double z) { return x * x / (2 * p.radius_x) + z * z / (2 * p.radius_z); };
}

HalfSpaceContact contact_of(const Paraboloid &p)
{
  constexpr double reach = 1.15;  // semi-axes; the load goes up by 20 % for the tangent, and they by 6 %
  const auto hertz       = hertz_point(p.load, p.radius_x, p.radius_z, contact_modulus(p.bodies));
  return {p.bodies,
          {reach * hertz.semi_x / p.n_x, p.n_x, Eigen::VectorXd::LinSpaced(p.n_z + 1, 0, reach * hertz.semi_y)},
          gap_of(p)};
}

// Semi-axis along z by the pressures of the column next to x = 0.
double semi_axis_z(const HalfSpaceState &s)
{
  std::vector<double> z, p;
  for (int j = 0; j < s.z.size() && s.pressure(0, j) > 0; ++j) {
    z.push_back(s.z[j]);
    p.push_back(s.pressure(0, j));
  }
  return fit_pressure(z, p).half_width;
}

struct EllipseReference {
  double semi_x, semi_z;  // mm
  double p0, approach;    // MPa, um
  double tangent;         // N/mm
  double tolerance;
};

std::vector<Check> ellipse(const Paraboloid &p, const EllipseReference &r)
{
  HalfSpaceContact contact = contact_of(p);
  const HalfSpaceState s   = contact.at_load(p.load);
  std::vector<Check> checks{
      relative("semi-axis across", "mm", s.half_width[0] / mm, r.semi_x, r.tolerance),
      relative("semi-axis along", "mm", semi_axis_z(s) / mm, r.semi_z, r.tolerance),
      relative("peak pressure", "MPa", s.peak_pressure[0] / MPa, r.p0, r.tolerance),
      relative("approach", "um", s.approach / um, r.approach, r.tolerance),
      relative("tangent", "N/mm", contact.tangent(p.load) / N_per_mm, r.tangent, r.tolerance)};
  add_identities(checks, contact, p.load);
  return checks;
}

std::vector<Check> sphere()
{
  return ellipse({half_spaces(steel, steel), 1000, 10 * mm, 10 * mm, 30, 30},
                 {0.402073, 0.402073, 2953.469, 16.1662, 92786, 0.003});
}

std::vector<Check> half_space_ellipse()
{
  return ellipse({half_spaces(steel, steel), 1000, 10 * mm, 20 * mm, 30, 30},
                 {0.356034, 0.564600, 2375.252, 14.3073, 104841, 0.003});
}

std::vector<Check> crowned_pair()
{
  return ellipse({half_spaces(steel, steel), 1e5, 152.941 * mm, 2.45e6 * mm, 30, 60},
                 {0.739114, 231.693, 278.816, 12.7414, 11772.7e3, 0.005});
}

// Steel roller R 12.5, L 40 on a steel half space under 20 kN.
struct Roller {
  double radius = 12.5 * mm, length = 40 * mm, load = 20e3;
  HalfSpaces bodies = half_spaces(steel, steel);
  double q() const
  {
    return load / length;
  }
  HertzLine hertz() const
  {
    return hertz_line(q(), radius, contact_modulus(bodies));
  }
  // Johns and Gohar's logarithm: bounded at the end.
  GapShape logarithmic() const
  {
    const double scale = q() / (M_PI * contact_modulus(bodies)),
                 cut   = 1 - 0.3033 * hertz().half_width / (length / 2);
    return [*this, scale, cut](const double x, const double z) {
      const double t = 2 * z / length;
      return x * x / (2 * radius) - scale * std::log(1 - cut * t * t);
    };
  }
  GapShape straight() const
  {
    return [R = radius](const double x, double) { return x * x / (2 * R); };
  }
  // `reach` half widths across.
  QuarterGrid grid(const double reach, const int n_x, const double at_end) const
  {
    return {reach * hertz().half_width / n_x, n_x, graded_edges(length / 2, 0.5 * mm, at_end, 1.25)};
  }
};

double flag(const bool singular)
{
  return singular ? 1 : 0;
}

Check flagged(const bool singular, const bool expected)
{
  return {"end flagged as singular (1: yes)", "-", flag(singular), flag(expected), 0, Judged::absolute};
}

std::vector<Check> roller_log()
{
  const Roller roller;
  const QuarterGrid grid = roller.grid(1.3, 20, 0.05 * mm);
  HalfSpaceContact contact(roller.bodies, grid, roller.logarithmic());
  const HalfSpaceState s = contact.at_load(roller.load);
  double flatness        = 0;
  for (int j = 0; j < s.z.size() && s.z[j] <= 18 * mm; ++j)
    flatness = std::max(flatness, std::abs(s.line_load[j] / roller.q() - 1));
  std::vector<Check> checks{
      relative("approach", "um", s.approach / um, 17.153, 0.003),
      relative("largest line load / mean", "-", s.line_load.maxCoeff() / roller.q(), 1.023, 0.01),
      at_most("line load / mean - 1 for |z| up to 18 mm", "-", flatness, 0.025)};
  // 0.9986 to 0.9997 by two other codes, as printed in the source
  checks.push_back({"mean pressure of the middle rectangle / Hertz", "-",
                    s.pressure(0, 0) / roller.hertz().peak_pressure, 0.9992, 0, Judged::reported});
  checks.push_back(flagged(has_singular_end(roller.bodies, grid, roller.logarithmic(), roller.load), false));
  add_identities(checks, contact, roller.load);
  return checks;
}

std::vector<Check> roller_sharp()
{
  constexpr double sharp_reach =
      3;  // at the end the line load is eight times the mean, and the contact wider as its root
  const Roller roller;
  std::vector<Check> checks;
  double before = 0, change = 0;
  for (const double at_end : {0.2 * mm, 0.05 * mm, 0.02 * mm}) {
    HalfSpaceContact contact(roller.bodies, roller.grid(sharp_reach, 30, at_end), roller.straight());
    const HalfSpaceState s = contact.at_load(roller.load);
    checks.push_back(
        relative(fmt::format("approach, end rows of {:g} mm", at_end / mm), "um", s.approach / um, 16.12, 0.003));
    change = std::abs(s.approach / before - 1);
    before = s.approach;
  }
  checks.push_back(at_most("change of the approach over the last refinement", "-", change, 0.001));
  checks.push_back(flagged(
      has_singular_end(roller.bodies, roller.grid(sharp_reach, 30, 0.05 * mm), roller.straight(), roller.load),
      true));
  return checks;
}

// Rigid strip punch: every strip touches, so the pressures follow from one linear system.
Eigen::VectorXd strip_punch(const HalfSpaces &bodies, const Eigen::VectorXd &edges, const double line_load)
{
  const int n = int(edges.size()) - 1;
  Eigen::MatrixXd A(n + 1, n + 1);  // unknowns: pressures, and the displacement of the punch
  for (int i = 0; i < n; ++i) {
    const double x = (edges[i] + edges[i + 1]) / 2;
    for (int j = 0; j < n; ++j) {
      const double s = (edges[j] + edges[j + 1]) / 2, half = (edges[j + 1] - edges[j]) / 2, datum = edges[n];
      A(i, j) = (strip_influence(bodies, half, x - s, datum) + strip_influence(bodies, half, x + s, datum))(1, 1);
      A(n, j) = 4 * half;
    }
    A(i, n) = -1;
  }
  A(n, n)               = 0;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 1);
  right[n]              = line_load;
  // Displacements per pressure are some 1e-15 m/Pa: scaled to the size of the last row.
  const double scale = A.topLeftCorner(n, n).cwiseAbs().maxCoeff() / A.row(n).head(n).maxCoeff();
  A.row(n) *= scale;
  A.col(n) *= A.topLeftCorner(n, n).cwiseAbs().maxCoeff();
  right[n] *= scale;
  return A.partialPivLu().solve(right).head(n);
}

std::vector<Check> half_space_punch()
{
  const HalfSpaces bodies = half_spaces(steel, rigid_material());
  const double a = 10 * mm, P = 10e3, q = 1000e3;
  const int n = 40;
  HalfSpaceContact punch(bodies, {a / n, n, Eigen::VectorXd::LinSpaced(n + 1, 0, a)}, [a](double x, double z) {
    return std::hypot(x, z) < a ? 0 : std::numeric_limits<double>::infinity();
  });
  const HalfSpaceState s = punch.at_load(P);
  std::vector<Check> checks{
      relative("circle: approach", "um", s.approach / um, 2.166667, 0.005),
      relative("circle: stiffness", "N/mm", s.set_tangent / N_per_mm, 4615384.6, 0.005),
      relative("circle: pressure in the middle", "MPa", s.pressure(0, 0) / MPa, 15.91549, 0.01)};
  const Eigen::VectorXd edges    = graded_edges(a, a / 20, a / 400, 1.2);
  const Eigen::VectorXd pressure = strip_punch(bodies, edges, q);
  for (const double x : {0.0, 0.5, 0.9}) {
    const int i = int(std::upper_bound(edges.data(), edges.data() + edges.size(), x * a) - edges.data()) - 1;
    const double middle = (edges[i] + edges[i + 1]) / 2;
    checks.push_back(relative(fmt::format("strip: pressure at x / a = {:.3f}", middle / a), "MPa",
                              pressure[i] / MPa, strip_punch_pressure(q, a, middle) / MPa, 0.01));
  }
  checks.push_back(at_most("circle: complementarity residual", "-", s.residual, 1e-12));
  return checks;
}

// The same sphere contact in millimetres and megapascals, and ten times as large.
std::vector<Check> scale_invariance()
{
  const Paraboloid p{half_spaces(steel, steel), 1000, 10 * mm, 10 * mm, 12, 12};
  const HalfSpaceState s = contact_of(p).at_load(p.load);
  const auto scaled      = [&](const std::string &name, const double length, const double modulus) {
    const Material m{210e9 * modulus, 0.3, 0};
    const double force = length * length * modulus;  // pressures then grow like the modulus
    Paraboloid q       = p;
    q.bodies           = half_spaces(m, m);
    q.load *= force;
    q.radius_x *= length;
    q.radius_z *= length;
    const HalfSpaceState t = contact_of(q).at_load(q.load);
    const double pressures = (t.pressure / modulus - s.pressure).cwiseAbs().maxCoeff() / s.pressure.maxCoeff();
    return std::vector<Check>{
        relative(name + ": approach / length", "-", t.approach / length / s.approach, 1, 1e-10),
        relative(name + ": tangent / (modulus length)", "-", t.set_tangent / (modulus * length) / s.set_tangent, 1,
                      1e-10),
        at_most(name + ": largest change of a pressure", "-", pressures, 1e-10)};
  };
  std::vector<Check> checks = scaled("mm and MPa", 1e3, 1e-6);
  for (const Check &c : scaled("10 x geometry", 10, 1))
    checks.push_back(c);
  return checks;
}

const char *const method = "Constant pressures on the rectangles of a quarter, mean gaps, exact active set.";
}  // namespace

std::vector<Case> half_space_cases()
{
  const char *const hertz = "K. L. Johnson, Contact Mechanics (1985), 4.2: Hertz's closed form";
  const char *const roller =
      "boundary elements with exact active set, two independent codes and several grids, whose spread the "
      "reference is the middle of; profile: P. M. Johns, R. Gohar, Tribology Int. 14 (1981) 131";
  std::vector<Case> cases;
  cases.push_back({"sphere-half-space", "verification",
                   "Sphere R 10 on flat, steel, 1000 N, on the half space: 900 pressures. " + std::string(method) +
                       " Second engine of the case sphere-flat; nothing is meshed.",
                   hertz,
                   "0.3 %: 26 rectangles on the radius and second order leave 0.02 % in approach and peak "
                   "pressure; radius and tangent are read off by a fit, finer than the grid",
                   sphere});
  cases.push_back({"ellipse-half-space", "verification",
                   "Radii 10 and 20 mm, steel, 1000 N, on the half space: 900 pressures. " + std::string(method),
                   hertz, "0.3 %, as the sphere", half_space_ellipse});
  cases.push_back({"crowned-pair", "verification",
                   "Rolls of radii 200 and 650 mm with a crown of 0.1 mm in radius at 700 mm, 100 kN, on the half "
                   "space: 1800 pressures, axis ratio 313. " +
                       std::string(method) +
                       " The contact is longer than the rolls are thick: a test of the operator, not of rolls.",
                   hertz, "0.5 %: 26 rectangles on the half width, each 150 times as long as wide", crowned_pair});
  cases.push_back({"roller-log", "regression",
                   "Steel roller R 12.5, L 40, with logarithmic profile on a steel half space, 20 kN. " +
                       std::string(method) + " Rows from 0.5 mm in the middle to 0.05 mm at the end.",
                   roller,
                   "approach 0.3 %; largest line load 1 %, which is where grids differ; flat within 2.5 % up to "
                   "18 mm, the profile's purpose",
                   roller_log});
  cases.push_back(
      {"roller-sharp", "regression",
       "The roller of roller-log, straight to a sharp end, end rows of 0.2, 0.05 and 0.02 mm. " +
           std::string(method) +
           " The pressure at the end grows without limit and is flagged, not reported: the largest pressure grows "
           "at least like the power -1/5 of the length of the end row when that is cut to a quarter (flat end: "
           "-1/2, soft end: 0).",
       roller, "approach 0.3 %, and 0.1 % between the last two grids: the spike carries no load in the limit",
       roller_sharp});
  cases.push_back(
      {"flat-punch-half-space", "verification",
       "Rigid flat punches on steel: circle of radius 10 mm under 10 kN as 1256 squares of 0.25 mm with a stepped "
       "rim, and strip of half width 10 mm under 1000 N/mm by strips down to 0.025 mm at the edge.",
       "K. L. Johnson, Contact Mechanics (1985), 2.8, 3.4 and 5.3",
       "0.5 % and 1 %: the stepped rim leaves 0.1 % and 0.3 %", half_space_punch});
  cases.push_back({"scale-invariance-half-space", "verification",
                   "The contact of sphere-half-space with 144 pressures in millimetres and megapascals, and ten "
                   "times as large.",
                   "dimensional analysis: the result is a function of ratios only",
                   "1e-10: round-off of the solution of some 100 equations, amplified by their condition",
                   scale_invariance});
  return cases;
}
}  // namespace mill::verify
