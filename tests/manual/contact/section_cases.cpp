#include "core/model/case.h"
#include "meshes/common/block.h"
#include "tests/manual/check/units.h"
#include "tests/manual/contact/convergence.h"
#include "tests/manual/contact/line_sections.h"
#include "tests/manual/contact/meshed.h"
#include "tests/manual/contact/round_sections.h"
#include "tests/manual/solvers/ring_mesh.h"
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

// Plane strain and axisymmetric bodies, meshed, condensed onto their contact surfaces and coupled.
namespace mill::verify {
namespace {
using Eigen::Vector2d;
using Eigen::VectorXd;
using fem::Section;

// ---- conforming rings
// Constant and cos 2 theta part of values at the angles of points around the origin, by least squares.
Vector2d harmonics(const Eigen::MatrixXd &points, const VectorXd &values)
{
  Eigen::MatrixXd basis(points.rows(), 2);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    basis.row(i) << 1, std::cos(2 * std::atan2(points(i, 1), points(i, 0)));
  return basis.colPivHouseholderQr().solve(values);
}

std::vector<Check> conforming_cylinders()
{
  const Material material{1e9, 0.2, 1000};
  const double p = 1e7, alpha = 1e5;
  const ScratchFile outer_file("outer"), inner_file("inner");
  const auto ring = [&](const double r1, const double r2, const int n_radial, const int n_angle,
                        const std::string &path) {
    return fem::SectionBody(meshes::mesh_ring(meshes::even_lines(r1, r2, n_radial), n_angle, path), material, 2,
                            Section::plane_strain, {{"inner", {0, 0}, r1}, {"outer", {0, 0}, r2}});
  };
  const auto outer = ring(0.6, 1, 6, 24, outer_file.path), inner = ring(0.2, 0.6, 6, 17, inner_file.path);
  const fem::CondensedSurface slave(outer.stiffness(), 2, held_quarter(outer), outer.surface("inner")),
      master(inner.stiffness(), 2, held_quarter(inner), inner.surface("outer"));
  // The load factor is the driven motion.
  const Surface loaded = outer.surface("outer");
  const auto pressure  = [&](const VectorXd &x) { return p + alpha * std::cos(2 * std::atan2(x[1], x[0])); };
  fem::DrivenMode factor;
  factor.slave_push = fem::load_on(loaded, fem::pressure_load(loaded, pressure), outer.stiffness().rows());
  fem::PairOptions options;
  options.gap     = [](const VectorXd &) { return 0; };
  const auto pair = fem::pair_bodies({&slave}, {&master}, {factor}, options);
  contact::ActiveSet solver(pair.problem);
  const contact::State state = solver.solve(prescribed(1));
  const VectorXd field       = slave.displacement(pair.slave_forces(state.nodal), factor.slave_push);
  const auto radial          = [&](const std::string &group) {
    const auto &nodes = outer.group(group);
    Eigen::MatrixXd points(Eigen::Index(nodes.size()), 2);
    VectorXd u(points.rows());
    for (Eigen::Index i = 0; i < u.size(); ++i) {
      points.row(i) = outer.nodes().row(nodes[i]);
      u[i]          = field.segment<2>(2 * nodes[i]).dot(points.row(i).normalized());
    }
    return harmonics(points, u);
  };
  const Vector2d contact = harmonics(pair.points(), pair.pressure(state.nodal)), rim = radial("outer"),
                 interface = radial("inner");
  std::vector<Check> checks{
      relative("contact pressure, mean", "MPa", contact[0] / MPa, 9.259259, 0.005),
      relative("contact pressure, cos 2 theta", "MPa", contact[1] / MPa, 0.13571791, 0.005),
      relative("radial displacement at radius 1, mean", "mm", rim[0] / mm, -8.0, 0.005),
      relative("radial displacement at radius 1, cos 2 theta", "mm", rim[1] / mm, -0.22402740, 0.005),
      relative("outer ring at the interface, mean", "mm", interface[0] / mm, -5.3333333, 0.005),
      relative("outer ring at the interface, cos 2 theta", "mm", interface[1] / mm, -0.18403349, 0.005),
  };
  add_identities(checks, solver, state);
  return checks;
}

// ---- units and size
struct ScaledSection {
  VectorXd pressure;  // over the modulus
  double motion, stiffness, half_width;
};

// Two steel half planes with a relative radius of 50 mm under 1000 N/mm, computed in multiples of `length` and
// `stress`.
ScaledSection scaled_contact(const double length, const double stress, const double size)
{
  const Material material{210e9 / stress, 0.3, 1};
  const double b = 0.743 * mm * size / length, R = 50 * mm * size / length,
               q    = 1000 * N_per_mm * size / length / stress;
  const auto first  = half_space_section({1.3 * b, 20, 100 * b, 1.4}, material, Section::plane_strain),
             second = half_space_section({1.3 * b, 13, 100 * b, 1.4}, material, Section::plane_strain);
  const auto slave  = condensed_patch(first, held_like_a_half_space(first)),
             master = condensed_patch(second, held_like_a_half_space(second));
  fem::PairOptions options;
  options.gap     = [&](const VectorXd &x) { return x[0] * x[0] / (2 * R); };
  const auto pair = fem::pair_bodies({&slave}, upside_down(master), {master_moves_down()}, options);
  contact::ActiveSet solver(pair.problem);
  const contact::State state = solver.solve(by_resultant(0.5 * q));
  return {pair.pressure(state.nodal) / material.youngs_modulus, state.motion[0] * length / size,
          1 / state.compliance(0, 0) * stress, fitted_ellipse(pair, state).half_width * length / size};
}

std::vector<Check> section_scale_invariance()
{
  const ScaledSection metres = scaled_contact(1, 1, 1);
  std::vector<Check> checks;
  const auto compare = [&](const std::string &what, const ScaledSection &other) {
    const auto differ = [](const double a, const double b) { return std::abs(a / b - 1); };
    const double worst =
        std::max({differ(other.motion, metres.motion), differ(other.stiffness, metres.stiffness),
                  differ(other.half_width, metres.half_width),
                  (other.pressure - metres.pressure).cwiseAbs().maxCoeff() / metres.pressure.maxCoeff()});
    checks.push_back({"largest relative difference, " + what, "-", worst, 1e-10, 0, Judged::at_most});
  };
  compare("mm and N/mm2 against m and Pa", scaled_contact(mm, MPa, 1));
  compare("10 x geometry", scaled_contact(1, 1, 10));
  checks.push_back(reported("half width", "mm", metres.half_width / mm, 0.742790));
  return checks;
}
}  // namespace

std::vector<Case> section_cases()
{
  std::vector<Case> cases;
  cases.push_back(
      {"cgs1-small", "verification",
       "NAFEMS CGS-1 at a hundredth of its load: steel half cylinder R 50 mm on a block of E 70 GPa, 200"
       " x 200 mm, base clamped, F 350 N per mm of thickness, plane strain, frictionless. The half "
       "cylinder is loaded uniformly on its cut plane and floats: one pin stops its rigid motion and "
       "carries nothing. Quadratic grids that do not match, dual multipliers; both bodies condensed onto"
       " their patches by the trailing block of a sparse Cholesky factor, exact active set; 24 000 unknowns.",
       "Hertz line contact, K. L. Johnson, Contact Mechanics (1985), 4.2; parameters: A. W. A. Konter, "
       "FENET-UNOTT-DLE-09 (2006)",
       "a/R = 0.012: the half-space solution holds to (a/R)^2; 19 elements on the half width leave "
       "(h/b)^2/20 in a nodal pressure, and the fit of the ellipse another 1e-4.",
       cgs1_small});
  cases.push_back({"cgs1-depth", "benchmark",
                   "CGS-1 at its full load, 35 kN per mm of thickness, modelled as cgs1-small, with small "
                   "displacements. Shown, not judged: the benchmark includes large deformation (a/R = 0.124), and "
                   "its block size and support are not confirmed.",
                   "u_y: code_aster ssnp154, quadratic elements; peak pressure and half width: Hertz",
                   "Nothing is judged but the identities.", cgs1_depth});
  cases.push_back(
      {"conforming-cylinders", "verification",
       "Ring of radii 1.0/0.6 m around a ring of radii 0.6/0.2 m, E 1 GPa, nu 0.2, plane strain, "
       "frictionless, outer pressure p + alpha cos 2 theta with p 1e7, alpha 1e5 Pa. Quarter rings with "
       "24 and 17 quadratic elements around, true circles and true nodal normals; the load factor is the"
       " driven mode; 2100 unknowns.",
       "Lame and Michell: closed-form stresses of each ring for both harmonics, matched at the "
       "interface; parameters: code_aster V6.03.167",
       "Edges leave their circle by R t^4/8 with t = 0.046 half the angle of an edge, and what grids "
       "that do not match transmit is a mean over the larger element, (h/R)^2/10 = 1e-3 of the second "
       "harmonic.",
       conforming_cylinders});
  cases.push_back(
      {"order-quadratic", "verification",
       "Rigid parabolic cylinder on a steel half plane, b 1 mm, of which the square 3 mm x 3 mm is "
       "meshed; the closed-form displacements are imposed on its other sides, so that the solution is "
       "known everywhere. L2 errors of displacement (area) and pressure (line) on four meshes of 12 to "
       "96 quadratic elements per side, once graded towards the edge of the contact (place proportional "
       "to distance squared), once even; up to 74 000 unknowns.",
       "Orders asked for: code_aster V6.03.150. Exact solution: Hertz pressure in Westergaard's stress "
       "function",
       "Stresses have a square root at the edge of the contact, which limits even meshes to 5/2 in the "
       "displacement and 1 in the pressure whatever the elements; they come near 5/2 from below. Graded "
       "meshes show the order of the elements.",
       order_quadratic});
  cases.push_back(
      {"sphere-flat", "verification",
       "Steel sphere R 10 mm on a steel flat, 1000 N. Two half spaces as axisymmetric cylinders of 2000 "
       "contact radii with 110 and 80 quadratic elements on the patch, not matching; the curvature is in"
       " the gap; condensed and solved as cgs1-small; 77 000 unknowns in all.",
       "Hertz; K. L. Johnson, Contact Mechanics (1985), 4.2",
       "The cylinders end at 2000 radii: 0.03 % of the approach. The tangent, 2 a E*, steps by one node "
       "when it joins, 0.5 % of a.",
       sphere_flat});
  cases.push_back(
      {"sphere-sphere", "verification",
       "Two spheres R 50 mm, E 20 GPa, nu 0.3, crushed by 4 mm and by 0.04 mm in all. Two half spaces as"
       " in sphere-flat with 40 and 30 elements on the patch and parabolic profiles, the approach "
       "imposed; 37 000 unknowns.",
       "Hertz, which is the exact solution of this model; real spheres leave it by a/R, 20 % and 2 %. "
       "Parameters: code_aster ssnv104a, whose coarse mesh returns 3176 MPa for the large crush",
       "p0 follows the square root of the approach, of which 0.03 % are lost beyond 2000 radii; 36 "
       "elements on the radius leave 1e-4.",
       sphere_sphere});
  cases.push_back(
      {"line-200-650", "verification",
       "Steel cylinders R 200 mm and R 650 mm, plane strain, q 200, 1000 and 5000 N/mm, each balanced by"
       " an equal load on its opposite generator: the datum is the distance of the axes. Quarter discs "
       "with true circles, factored once for the three loads; grids that do not match, 24 and 17 "
       "elements per half width; 55 000 unknowns.",
       "Hertz; K. L. Johnson, Contact Mechanics (1985), eq. 5.57, for each body",
       "b/R = 0.015 at most, errors (b/R)^2; the tangent steps by (1/m)/12.5 of its value, m = 48 nodes "
       "on b, when a node joins.",
       line_200_650});
  cases.push_back({"line-210-725", "verification",
                   "The demo stand's work roll on its backup roll as solid cylinders, R 210 mm and R 725 mm, nu "
                   "0.28, plane strain, 976.2 kN on 1400 mm; held as in line-200-650; 18 000 unknowns.",
                   "K. L. Johnson, Contact Mechanics (1985), eq. 5.57, for each body, derived with respect to q",
                   "As line-200-650.", line_210_725});
  cases.push_back(
      {"disc-r10", "verification",
       "Steel disc R 10 mm between two rigid plates, q 500 N/mm, plane strain: a quarter with its true "
       "circle, 24 elements or more on b; 9700 unknowns. Nodes are pressed along the plates' normal.",
       "Twice Johnson's eq. 5.57, Contact Mechanics (1985)",
       "b/R = 0.017, errors (b/R)^2 = 3e-4. Forces along the disc's own undeformed normals would err by "
       "0.14 b/R.",
       disc_r10});
  cases.push_back({"disc-r50", "verification",
                   "Steel disc R 50 mm between two rigid plates, q 1000 N/mm, as disc-r10; 10 000 unknowns.",
                   "Twice Johnson's eq. 5.57, Contact Mechanics (1985)", "As disc-r10, b/R = 0.011.", disc_r50});
  cases.push_back(
      {"flat-punch", "verification",
       "Rigid flat circular punch, radius 10 mm, on a steel half space, 10 kN: an axisymmetric cylinder "
       "of 2000 radii whose mesh lines crowd at the edge of the punch; 35 000 unknowns.",
       "K. L. Johnson, Contact Mechanics (1985), 3.8: p = P/(2 pi a sqrt(a^2 - r^2)), approach P/(2 a "
       "E*)",
       "The half space ends at 2000 radii, 0.03 %, and the first element at the singular edge, 0.002 a, "
       "makes the punch 0.05 % too stiff. In the middle elements are largest, 0.2 a, and a piecewise "
       "linear pressure represents the true one there.",
       flat_punch});
  cases.push_back(
      {"scale-invariance-section", "verification",
       "Two steel half planes with a relative radius of 50 mm, q 1000 N/mm, grids that do not match, "
       "computed in m and Pa, in mm and N/mm2, and ten times as large with ten times the load per "
       "thickness: approach, tangent, half width and every nodal pressure, made dimensionless, agree; 10 500 "
       "unknowns.",
       "Identity: linear elasticity has no length and no unit of its own",
       "Rounding times the condition of the bodies, about 1e4; every threshold of the chain is relative.",
       section_scale_invariance});
  cases.push_back(
      {"cattaneo-line-section", "verification",
       "Steel cylinder R 50 mm on a steel flat, q 1000 N/mm, pressed and then pushed sideways with "
       "0.25 and 0.5 of the "
       "sliding load, friction 0.3. Two half planes meshed over their whole width, grids that do not "
       "match, condensed "
       "with their tangents; stick and slip on the dense operator; Fourier solver of cattaneo-line; 35 "
       "000 unknowns.",
       "Cattaneo and Mindlin; K. L. Johnson, Contact Mechanics (1985), 7.2",
       "0.5 %, a quarter of what is asked for: 30 elements on b leave (h/b)^2 = 1e-3 in nodal "
       "tractions, and the ellipses "
       "through them less.",
       cattaneo_line_section});
  return cases;
}
}  // namespace mill::verify
