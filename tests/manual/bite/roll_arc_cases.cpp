#include "core/model/case.h"
#include "fem/strip/bite_roll.h"
#include "meshes/roll/bite_roll.h"
#include "reduce/bite/slab/path_stiffness.h"
#include "tests/manual/check/units.h"
#include "tests/manual/check/verification.h"
#include "tests/manual/contact/meshed.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

// How far the surface of a work roll deflects in the bite: the section by finite elements against the half plane.
namespace mill::verify {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

const Material roll_steel{210e9, 0.28, 7700};
// Demo pass: roll 420 mm, 8 -> 5 mm.
constexpr double radius = 210 * mm;
const double arc        = std::sqrt(radius * 3 * mm);

struct Meshed {
  fem::BiteRollResult result;
  VectorXd position;
};

meshes::BiteRollSize size_of(const double spacing, const double roll_radius = radius, const double draft_arc = arc)
{
  meshes::BiteRollSize size;
  size.radius  = roll_radius;
  size.arc     = draft_arc;
  size.spacing = spacing;
  return size;
}

fem::BiteRoll roll_of(const meshes::BiteRollSize &size, const double backup_half_width)
{
  fem::BiteRoll roll;
  roll.radius            = size.radius;
  roll.arc               = size.arc;
  roll.material          = roll_steel;
  const auto points      = meshes::arc_points(size);
  roll.position          = Eigen::Map<const VectorXd>(points.data(), Index(points.size()));
  roll.backup_half_width = backup_half_width;
  return roll;
}

Meshed roll_section(const meshes::BiteRollSize &size, const double backup_half_width,
                    const bool with_shear = false, const meshes::BiteRollSize *coarse = nullptr)
{
  fem::BiteRoll roll = roll_of(size, backup_half_width);
  roll.with_shear    = with_shear;
  const ScratchFile file("bite-roll"), coarse_file("bite-roll-coarse");
  const MeshFile mesh = meshes::mesh_bite_roll(size, file.path);
  MeshFile second;
  if (coarse)
    second = meshes::mesh_bite_roll(*coarse, coarse_file.path);
  return {fem::bite_roll_flexibility(roll, mesh, coarse ? &second : nullptr), roll.position};
}

// Antiderivatives of ln|s| and s ln|s|.
double log_integral(const double s)
{
  return s == 0 ? 0 : s * (std::log(std::abs(s)) - 1);
}
double first_moment(const double s)
{
  return s == 0 ? 0 : 0.5 * s * s * (std::log(std::abs(s)) - 0.5);
}

// Half plane under pressure that is linear between points, with the datum of a solid roll, (20.3): exact.
VectorXd half_plane(const VectorXd &x, const VectorXd &p, const double roll_radius)
{
  const double A = 2 * (1 - std::pow(roll_steel.poisson_ratio, 2)) / (M_PI * roll_steel.youngs_modulus);
  const double c = std::log(2 * roll_radius) - 1;
  VectorXd u     = VectorXd::Zero(x.size());
  for (Index i = 0; i < x.size(); ++i)
    for (Index j = 0; j + 1 < x.size(); ++j) {
      // p(t) = p_j + slope (t - x_j); with s = t - x_i:  value at s = 0, then the integrals over s
      const double h = x[j + 1] - x[j], slope = (p[j + 1] - p[j]) / h, a = x[j] - x[i], b = x[j + 1] - x[i];
      const double at_i = p[j] - slope * a;
      u[i] += A * (c * 0.5 * (p[j] + p[j + 1]) * h - at_i * (log_integral(b) - log_integral(a)) -
                   slope * (first_moment(b) - first_moment(a)));
    }
  return u;
}

// Pressure over the share of the arc, 0 at the exit and 1 at the entry.
VectorXd hill(const VectorXd &x, const std::function<double(double)> &shape)
{
  VectorXd p = VectorXd::Zero(x.size());
  for (Index i = 0; i < x.size(); ++i)
    if (const double s = x[i] / arc; s > -1e-9 && s < 1 + 1e-9)
      p[i] = shape(std::clamp(s, 0., 1.));
  return p;
}
double ellipse(const double s)
{
  return 50 * MPa * std::sqrt(std::max(0., 1 - std::pow(2 * s - 1, 2)));
}
// Friction hill of a rigid-plastic strip: steps at both ends, a peak at a third of the arc.
double friction_hill(const double s)
{
  const double peak = 0.34;
  return (28 + 29 * (s < peak ? s / peak : (1 - s) / (1 - peak))) * MPa;
}

// Largest difference of the two shapes u(x) - u(0) on and around the arc, relative to the larger range.
double shape_difference(const VectorXd &x, const VectorXd &u, const VectorXd &v)
{
  Index zero = 0;
  x.cwiseAbs().minCoeff(&zero);
  double range = 0, difference = 0;
  for (Index i = 0; i < x.size(); ++i)
    if (x[i] >= -0.3 * arc && x[i] <= 1.2 * arc) {
      range      = std::max(range, std::abs(v[i] - v[zero]));
      difference = std::max(difference, std::abs(u[i] - u[zero] - v[i] + v[zero]));
    }
  return difference / range;
}

std::vector<Check> against_half_plane()
{
  const auto coarse = size_of(0.08);
  const Meshed roll = roll_section(size_of(0.04), 6 * mm, true, &coarse);
  const VectorXd &x = roll.position;
  const MatrixXd &C = roll.result.flexibility.influence;
  std::vector<Check> checks;
  for (const auto &[name, shape] :
       {std::pair<const char *, double (*)(double)>{"elliptic hill", ellipse}, {"friction hill", friction_hill}}) {
    const VectorXd p = hill(x, shape), u = C * p, v = half_plane(x, p, radius);
    checks.push_back(at_most(std::string(name) + ": shape of the arc, largest difference / range", "-",
                             shape_difference(x, u, v), 0.02));
    Index zero = 0, highest = 0;
    x.cwiseAbs().minCoeff(&zero);
    p.maxCoeff(&highest);
    checks.push_back(relative(std::string(name) + ": flattening at the peak", "um", u[highest] / 1e-6,
                              v[highest] / 1e-6, 0.02));
  }
  checks.push_back(at_most("shape of the arc, mesh twice as coarse", "-", roll.result.error_estimate, 0.002));
  const VectorXd p = hill(x, friction_hill);
  VectorXd tau     = 0.2 * p;
  for (Index i = 0; i < x.size(); ++i)
    if (x[i] < 0.34 * arc)
      tau[i] = -tau[i];
  const VectorXd u = C * p, v = u + roll.result.shear_influence * tau;
  checks.push_back(
      reported("friction 0.2 p on the arc: change of the shape / range", "-", shape_difference(x, v, u), 0));
  return checks;
}

// An arc so short that the section around it is a half plane, up to the order arc / radius.
std::vector<Check> short_arc()
{
  const double short_radius = 400 * arc;
  const Meshed roll         = roll_section(size_of(0.04, short_radius, arc), 0.2 * arc, true);
  const VectorXd &x         = roll.position;
  const MatrixXd &C         = roll.result.flexibility.influence;
  const double E = roll_steel.youngs_modulus, nu = roll_steel.poisson_ratio;
  std::vector<Check> checks;
  for (const auto &[name, shape] :
       {std::pair<const char *, double (*)(double)>{"elliptic hill", ellipse}, {"friction hill", friction_hill}}) {
    const VectorXd p = hill(x, shape);
    checks.push_back(at_most(std::string(name) + ": shape of the arc, largest difference / range", "-",
                             shape_difference(x, C * p, half_plane(x, p, short_radius)), 0.002));
  }
  // Elliptic pressure around the line of centres: Johnson's distance from the contact line to the axis.
  const double a0 = 0.5 * arc;
  VectorXd p      = VectorXd::Zero(x.size());
  double q        = 0;
  Index zero      = 0;
  x.cwiseAbs().minCoeff(&zero);
  for (Index i = 0; i < x.size(); ++i)
    p[i] = 50 * MPa * std::sqrt(std::max(0., 1 - std::pow(x[i] / a0, 2)));
  for (Index i = 0; i + 1 < x.size(); ++i)
    q += 0.5 * (p[i] + p[i + 1]) * (x[i + 1] - x[i]);
  const double A = 2 * (1 - nu * nu) / (M_PI * E);
  checks.push_back(relative("flattening under an ellipse against A q [ln(4 R/a0) - 1/2]", "um",
                            (C.row(zero) * p)(0) / 1e-6, A * q * (std::log(4 * short_radius / a0) - 0.5) / 1e-6,
                            0.002));
  // Even friction over the arc tilts a half plane by a known slope.
  const VectorXd tau = hill(x, [](double) { return 10 * MPa; });
  const VectorXd u   = roll.result.shear_influence * tau;
  Index index        = 0;
  (x.array() - arc).abs().minCoeff(&index);
  checks.push_back(relative("even friction stress: depth of the entry below the exit", "um",
                            (u[index] - u[zero]) / 1e-6, (1 - 2 * nu) * (1 + nu) / E * 10 * MPa * arc / 1e-6,
                            0.05));
  return checks;
}

// Pressure of Bland and Ford in the demo pass, (8.5) and (8.6): k 28 MPa, mu 0.2, no tension.
double bland_ford(const double x)
{
  const double h_d = 5 * mm, h_e = 8 * mm, mu = 0.2, h = h_d + x * x / radius;
  const auto H = [&](const double position) {
    return 2 * std::sqrt(radius / h_d) * std::atan(position / std::sqrt(radius * h_d));
  };
  return 28 * MPa * std::min(h / h_e * std::exp(mu * (H(arc) - H(x))), h / h_d * std::exp(mu * H(x)));
}

// Straight line between points.
VectorXd interpolated(const VectorXd &x, const VectorXd &y, const VectorXd &positions)
{
  VectorXd out(positions.size());
  for (Index i = 0; i < positions.size(); ++i) {
    Index k = 1;
    while (k + 1 < x.size() && x[k] < positions[i])
      ++k;
    out[i] = y[k - 1] + (y[k] - y[k - 1]) * (positions[i] - x[k - 1]) / (x[k] - x[k - 1]);
  }
  return out;
}

std::vector<Check> path_form()
{
  const double width = 1;
  const Meshed roll  = roll_section(size_of(0.04), 6 * mm);
  const VectorXd &x  = roll.position;
  const VectorXd u   = roll.result.flexibility.influence * hill(x, [](double s) { return bland_ford(s * arc); });
  const auto with    = [&](const int n) {
    const VectorXd positions = VectorXd::LinSpaced(n, 0, arc);
    VectorXd p(n);
    for (Index i = 0; i < n; ++i)
      p[i] = bland_ford(positions[i]);
    return bite::path_stiffness(positions, p, interpolated(x, u, positions), width);
  };
  const auto coarse = with(49), fine = with(97);
  const double A         = 2 * (1 - std::pow(roll_steel.poisson_ratio, 2)) / (M_PI * roll_steel.youngs_modulus);
  const double flat      = width / (A * (std::log(8 * radius / arc) - 0.5));  // (8.12)
  const double kN_per_mm = 1e6;
  return {
      relative("flattening of one roll (8.12)", "kN/mm", flat / kN_per_mm, 9.6641e4, 1e-4),
      relative("plateau with 97 nodes / with 49", "-", fine.plateau / coarse.plateau, 0.5, 0.2),
      {"log2 of sum of forces over mean displacement, against (8.12)", "-", std::log2(fine.sum / flat), 0, 1,
       Judged::absolute},
      relative("that sum, 97 nodes against 49", "kN/mm", fine.sum / kN_per_mm, coarse.sum / kN_per_mm, 0.02),
      reported("plateau, 49 nodes, compared with the published K4", "kN/mm", coarse.plateau / kN_per_mm, 1.911e5),
  };
}
}  // namespace

std::vector<Case> roll_arc_cases()
{
  const Case demo{
      "roll-arc-half-plane",
      "verification",
      "Work roll of the demo pass (radius 210 mm, 8 to 5 mm, back-up roll opposite) as a whole section of "
      "quadratic elements in plane strain, four parities of its quarter; surface displacement in the bite under "
      "an elliptic "
      "hill and under the hill of a rigid-plastic strip with its pressure steps, against the half plane.",
      "half plane under piecewise linear pressure, integrated exactly, with the datum A q [ln(4 R/a0) - 1/2] of a "
      "solid roll (theory.md 20); K. L. Johnson, Contact Mechanics (1985), chapters 2 and 5",
      "2 %: the half plane leaves out that on a roll the pressure is radial and the surface curved, which is of "
      "the order arc / radius (0.12) times (1 - 2 nu)/(1 - nu); the mesh contributes less than 0.1 %, shown by "
      "the "
      "one twice as coarse",
      against_half_plane};
  const Case limit{
      "roll-arc-short",
      "verification",
      "The same section with a radius of 400 arcs, where it must become a half plane: shape of the arc, distance "
      "from the surface to the axis, and the tilt of the surface by friction.",
      "as above; friction on a half plane: K. L. Johnson, Contact Mechanics (1985), (2.22)",
      "0.2 %: the curvature contributes 0.05 % at this radius, the mesh as much; 5 % for friction, because the "
      "surface is also "
      "shifted along the rolling direction against the axis, which on a circle is a tilt of the order "
      "ln(radius / arc) arc / radius of it",
      short_arc};
  const Case path{
      "path-stiffness",
      "verification",
      "K4 of the path form in the demo pass, width 1 m: nodal force over the roll's displacement at the node, "
      "from the slab's pressure and the finite-element roll, with 49 and 97 nodes on the arc, 20 % of them left "
      "out at each end.",
      "a nodal force is proportional to the element length, so the plateau halves with "
      "twice the nodes; published 1.911e11 N/m",
      "20 % for the halving, a factor of 2 for the sum against the closed form of the flattening, both from the "
      "acceptance case: the closed form spreads the force as an ellipse over the arc and reads the displacement "
      "in its middle. 2 % between the two meshes: half an element at each end",
      path_form};
  return {demo, limit, path};
}
}  // namespace mill::verify
