#include "core/model/case.h"
#include "fem/body/elastic_body.h"
#include "meshes/common/block.h"
#include "tests/manual/check/units.h"
#include "tests/manual/contact/meshed.h"
#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>

// Three-dimensional bodies, meshed, condensed and coupled.
namespace mill::verify {
namespace {
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

contact::Loading by_resultant(const double value)
{
  return {VectorXd::Constant(1, value), {}};
}

// ---- patch test
// -------------------------------------------------------------------------------------------------- Base held
// vertically, two sides as planes of symmetry: no rigid motion, and nothing that hinders the uniform state.
template <class Body> std::vector<char> held_cube(const Body &body, const int components)
{
  std::vector<char> held(body.stiffness().rows(), 0);
  for (const int node : body.group("bottom"))
    held[components * node + 1] = 1;
  for (const int node : body.group("left"))
    held[components * node] = 1;
  if (components == 3)
    for (const int node : body.group("back"))
      held[components * node + 2] = 1;
  return held;
}

// Largest relative deviations of pressure and of the interface's vertical displacement from the uniform state.
template <class Body>
Vector2d patch_errors(const Body &lower, const Body &upper, const int d, std::vector<Check> *identities)
{
  const fem::CondensedSurface slave(lower.stiffness(), d, held_cube(lower, d), lower.surface("patch")),
      master(upper.stiffness(), d, held_cube(upper, d), upper.surface("patch"));
  VectorXd flip = VectorXd::Ones(d), shift = VectorXd::Zero(d), down = VectorXd::Zero(d);
  flip[1]  = -1;
  shift[1] = 4 * mm;
  down[1]  = -1;
  fem::DrivenMode mode;
  mode.master.translation = down;
  const auto pair         = fem::pair_bodies({&slave}, {&master, flip.asDiagonal(), shift}, {mode});
  contact::ActiveSet solver(pair.problem);
  const contact::State state = solver.solve({VectorXd::Constant(1, 0.2 * mm), {1}});
  const VectorXd pressure = pair.pressure(state.nodal), below = slave.displacement(pair.slave_forces(state.nodal)),
                 above = master.displacement(pair.master_forces(state.nodal));
  Vector2d worst((pressure.array() / (10000 * MPa) - 1).abs().maxCoeff(), 0);
  for (const int node : lower.group("patch"))
    worst[1] = std::max(worst[1], std::abs(below[d * node + 1] / (-0.1 * mm) - 1));
  for (const int node : upper.group("patch"))  // upside down: up in its own coordinates is down
    worst[1] = std::max(worst[1], std::abs(above[d * node + 1] / (-0.1 * mm) - 1));
  if (identities)
    add_identities(*identities, solver, state);
  return worst;
}

std::vector<Check> patch_flat()
{
  const Material material{2e11, 0, 1};
  std::vector<Check> checks;
  const auto add = [&](const std::string &kind, const Vector2d &errors) {
    checks.push_back(
        {"interface pressure against 10 000 MPa, " + kind, "-", errors[0], 1e-10, 0, Judged::at_most});
    checks.push_back({"interface u_z against -0.1 mm, " + kind, "-", errors[1], 1e-10, 0, Judged::at_most});
  };
  std::vector<Check> identities;
  for (const int degree : {1, 2}) {
    const std::string kind = degree == 1 ? "linear" : "quadratic";
    const auto cube        = [&](const int nx, const int ny, const int nz, const std::string &name) {
      const ScratchFile file(name);
      const auto even = [](const int n) { return meshes::even_lines(0, 2 * mm, n); };
      return fem::ElasticBody(meshes::mesh_block({even(nx), even(ny), even(nz)}, file.path), material, degree);
    };
    const auto square = [&](const int nx, const int ny, const std::string &name) {
      const ScratchFile file(name);
      const auto even = [](const int n) { return meshes::even_lines(0, 2 * mm, n); };
      return fem::SectionBody(meshes::mesh_block({even(nx), even(ny), {}}, file.path), material, degree,
                              fem::Section::plane_strain);
    };
    add("cubes, " + kind,
        patch_errors(cube(3, 2, 4, "lower"), cube(4, 3, 5, "upper"), 3, degree == 2 ? &identities : nullptr));
    add("squares, " + kind, patch_errors(square(5, 2, "lower"), square(7, 3, "upper"), 2, nullptr));
  }
  checks.insert(checks.end(), identities.begin(), identities.end());
  return checks;
}

// Even on the patch; twice as large from one to the next up to `near` beyond it, where fields still change fast;
// three times farther out.
std::vector<double> lines_outwards(const double patch, const int n_patch, const double element, const double near,
                                   const double extent)
{
  auto out           = meshes::mesh_lines({patch, n_patch, element, 2, patch + near});
  const double reach = out.back(), last = reach - out[out.size() - 2];
  const auto far = meshes::mesh_lines({0, 0, 3 * last, 3, extent - reach});
  for (std::size_t i = 1; i < far.size(); ++i)
    out.push_back(reach + far[i]);
  return out;
}

// ---- ellipse
// -----------------------------------------------------------------------------------------------------

// Tangent at `load` of the curve fitted by ln(approach) = c0 + c1 u + c2 u^2, u = ln(F / load), over a third below
// and above: d(ln F)/d(ln approach) = 1 / c1 there.  Of a point contact between half spaces ln(approach) is a
// straight line in u, so that the fit has no error of its own.
double fitted_tangent(contact::ActiveSet &solver, const double load)
{
  const VectorXd u = VectorXd::LinSpaced(15, -std::log(4. / 3), std::log(4. / 3));
  Eigen::MatrixXd powers(u.size(), 3);
  VectorXd approach(u.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    powers.row(i) << 1, u[i], u[i] * u[i];
    approach[i] = std::log(solver.solve(by_resultant(load * std::exp(u[i]))).motion[0]);
  }
  const Vector3d c = powers.colPivHouseholderQr().solve(approach);
  return load / (std::exp(c[0]) * c[1]);
}

std::vector<Check> ellipse_h3()
{
  const double Rx = 20 * mm, Rz = 10 * mm, a = 0.564600 * mm, b = 0.356034 * mm, P = 1000, extent = 700 * a;
  const ScratchFile file("ellipse");
  const int n = 6;  // quadratic elements on each half width of the patch
  meshes::BlockGrid grid;
  grid.patch_x = 1.12 * a;
  grid.patch_z = 1.12 * b;
  grid.x       = lines_outwards(grid.patch_x, n, grid.patch_x / n, 7 * a, extent);
  grid.z       = lines_outwards(grid.patch_z, n, grid.patch_z / n, 7 * a, extent);
  for (const double depth : lines_outwards(0, 0, grid.patch_z / n, 7 * a, extent))
    grid.y.insert(grid.y.begin(), -depth);
  const fem::ElasticBody body(meshes::mesh_block(grid, file.path), steel, 2);
  std::vector<char> held(body.stiffness().rows(), 0);
  for (const int node : body.group("left"))
    held[3 * node] = 1;
  for (const int node : body.group("back"))
    held[3 * node + 2] = 1;
  for (const int node : body.group("bottom"))
    held[3 * node] = held[3 * node + 1] = held[3 * node + 2] = 1;
  fem::SurfaceOptions up;
  up.direction = Vector3d(0, 1, 0);
  const fem::CondensedSurface slave(body.stiffness(), 3, held, body.surface("patch"), up);
  fem::DrivenMode mode;
  mode.master.translation = Vector3d(0, -1, 0);
  fem::PairOptions options;
  options.gap     = [&](const VectorXd &x) { return x[0] * x[0] / (2 * Rx) + x[2] * x[2] / (2 * Rz); };
  const auto pair = fem::pair_with_rigid({&slave, {}, {}, 2}, {mode}, options);  // both bodies are this one
  contact::ActiveSet solver(pair.problem);
  const contact::State state = solver.solve(by_resultant(P / 4));
  // The exact tangent steps with every node that joins, by about 1 % here: it is taken from a fit of the curve.
  const double tangent = fitted_tangent(solver, P / 4);
  // p^2 = p0^2 (1 - x^2/a^2 - z^2/b^2) through the nodes of the inner part, least squares.
  const VectorXd p             = pair.pressure(state.nodal);
  const Eigen::MatrixXd points = pair.points();
  std::vector<int> inner;
  for (Eigen::Index i = 0; i < p.size(); ++i)
    if (std::pow(points(i, 0) / a, 2) + std::pow(points(i, 2) / b, 2) < 0.81)
      inner.push_back(int(i));
  Eigen::MatrixXd basis(Eigen::Index(inner.size()), 3);
  VectorXd square(basis.rows());
  for (Eigen::Index i = 0; i < basis.rows(); ++i) {
    basis.row(i) << 1, std::pow(points(inner[i], 0), 2), std::pow(points(inner[i], 2), 2);
    square[i] = p[inner[i]] * p[inner[i]];
  }
  const Vector3d fit = basis.colPivHouseholderQr().solve(square);
  std::vector<Check> checks{
      {"larger semi-axis", "mm", std::sqrt(-fit[0] / fit[1]) / mm, 0.564600, 0.01},
      {"smaller semi-axis", "mm", std::sqrt(-fit[0] / fit[2]) / mm, 0.356034, 0.01},
      {"peak pressure", "MPa", std::sqrt(fit[0]) / MPa, 2375.252, 0.01},
      {"approach", "um", state.motion[0] / um, 14.3073, 0.01},
      {"dF/d(approach), of the fitted curve", "kN/mm", 4 * tangent / 1e6, 104.841, 0.005},
  };
  checks.push_back({"dF/d(approach), of the nodes that touch", "kN/mm", 4 / state.compliance(0, 0) / 1e6, 104.841,
                    0, Judged::reported});
  add_identities(checks, solver, state);
  return checks;
}
// ---- Schur complement
// --------------------------------------------------------------------------------------------
std::vector<Check> schur_order()
{
  const ScratchFile file("schur");
  meshes::BlockGrid grid;
  grid.x       = meshes::mesh_lines({1, 3, 0, 1.6, 4});
  grid.z       = meshes::even_lines(0, 3, 4);
  grid.y       = meshes::even_lines(-2, 0, 3);
  grid.patch_x = 1;
  const fem::ElasticBody body(meshes::mesh_block(grid, file.path), steel, 2);
  // Retained: the vertical unknowns of the patch, first as they come and then backwards; the base is held.
  std::vector<char> held(body.stiffness().rows(), 0);
  for (const int node : body.group("bottom"))
    held[3 * node] = held[3 * node + 1] = held[3 * node + 2] = 1;
  std::vector<int> place(held.size(), -1), node_of;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!held[i]) {
      place[i] = int(node_of.size());
      node_of.push_back(int(i) / 3);
    }
  const auto n = Eigen::Index(node_of.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < body.stiffness().cols(); ++j)
    for (SymmetricSparse::InnerIterator it(body.stiffness(), j); it; ++it)
      if (place[it.row()] >= 0 && place[j] >= 0)
        entries.emplace_back(place[it.row()], place[j], it.value());
  SymmetricSparse K(n, n);
  K.setFromTriplets(entries.begin(), entries.end());
  std::vector<int> retained, inside;
  std::vector<char> is_retained(node_of.size(), 0);
  for (const int node : body.group("patch")) {
    retained.push_back(place[3 * node + 1]);
    is_retained[place[3 * node + 1]] = 1;
  }
  for (int i = 0; i < int(n); ++i)
    if (!is_retained[i])
      inside.push_back(i);

  // S = K_rr - K_ri K_ii^-1 K_ir with dense matrices and another factorisation.
  const Eigen::SparseMatrix<double> both = K.selfadjointView<Eigen::Upper>();
  const Eigen::MatrixXd whole(both);
  const Eigen::MatrixXd K_ii = whole(inside, inside), K_ir = whole(inside, retained);
  const Eigen::MatrixXd S = whole(retained, retained) - K_ir.transpose() * K_ii.ldlt().solve(K_ir);
  const auto deviation    = [&](const std::vector<int> &order, const Eigen::MatrixXd &wanted) {
    const Eigen::MatrixXd L = CondensingFactor(K, node_of, order).schur_factor();
    return (L * L.transpose() - wanted).cwiseAbs().maxCoeff() / wanted.cwiseAbs().maxCoeff();
  };
  const std::vector<int> backwards(retained.rbegin(), retained.rend());
  std::vector<Check> checks;
  const auto add = [&](const std::string &what, const double result) {
    checks.push_back({what, "-", result, 1e-10, 0, Judged::at_most});
  };
  add("L22 L22^T against the explicit Schur complement", deviation(retained, S));
  add("the same, retained unknowns listed backwards", deviation(backwards, S.reverse()));
  return checks;
}
}  // namespace

std::vector<Case> solid_cases()
{
  std::vector<Case> cases;
  cases.push_back(
      {"patch-flat", "verification",
       "Two cubes (and two squares in plane strain) of side 2 mm, E 2e5 MPa, nu 0, stand on each other "
       "with grids that do not match (3 x 4 on 4 x 5 faces; 5 on 7), linear and quadratic; the base of "
       "the upper one moves down by 0.2 mm. Both bodies condensed onto their faces, dual multipliers "
       "integrated over clipped polygons, exact active set; up to 2600 unknowns.",
       "R. L. Taylor, P. Papadopoulos, On a patch test for contact problems in two dimensions (1991); "
       "uniform strain is the exact solution. Parameters: code_aster V6.04.167",
       "The state is in the element space, and every integral of the coupling is exact on flat "
       "rectangles: rounding only, 1e-16 times the condition of the condensed problem, about 1e3.",
       patch_flat});
  cases.push_back(
      {"ellipse-h3", "verification",
       "Two steel bodies with relative radii 20 mm and 10 mm pressed by 1000 N. A quarter of one half "
       "space is meshed as a brick of 700 major semi-axes with 6 quadratic hexahedra on each half width "
       "of the patch (60 000 unknowns); the other body is its mirror image, so its flexibility is taken "
       "twice; the curvature is in the gap.",
       "Hertz; K. L. Johnson, Contact Mechanics (1985), 4.2, elliptic integrals by the arithmetic-"
       "geometric mean",
       "1 %: five elements on a half width leave (h/b)^2/20 in a nodal pressure, and single nodes at the"
       " edge h/2. 0.5 % of the tangent: the brick ends at 700 semi-axes, 0.1 %, and elements double in "
       "size away from the patch, 0.2 %. The tangent is that of the curve, fitted over a third of the load "
       "below and above, because that of one set of touching nodes steps by 1 % when a node joins.",
       ellipse_h3});
  cases.push_back(
      {"schur-order", "unit",
       "A brick condensed onto the 63 vertical unknowns of a patch by the trailing block of its sparse "
       "Cholesky factor, against K_rr - K_ri K_ii^-1 K_ir from dense matrices. The factor is that of the"
       " Schur complement only if the retained unknowns stayed last, in the order in which they were "
       "listed.",
       "Identity: block elimination", "Two factorisations of one matrix: rounding times its condition, about 1e5.",
       schur_order});
  return cases;
}
}  // namespace mill::verify
