#include "tests/manual/contact/line_sections.h"
#include "meshes/common/block.h"
#include "tests/manual/check/units.h"
#include "tests/manual/contact/meshed.h"
#include <cmath>
#include <fmt/format.h>

namespace mill::verify {
namespace {
using Eigen::Vector2d;
using Eigen::VectorXd;
using fem::Section;

struct LineLoad {
  double q, b, p0, approach, tangent;  // N/m, m, Pa, m, N/m2: section 8.4 of the acceptance table
};

double sagitta(const double radius, const double x)
{
  return x * x / (radius + std::sqrt(radius * radius - x * x));
}

// Two cylinders, each balanced by an equal load on its opposite generator; non-matching grids on the two patches,
// for half widths of contact from `small` to `large` (m).
fem::BodyPair two_discs(const double R1, const double R2, const Material &material, const double small,
                        const double large)
{
  const auto first  = disc_section(R1, small, large, 24, material),
             second = disc_section(R2, small, large, 17, material);
  const auto slave  = condensed_patch(first, held_quarter(first)),
             master = condensed_patch(second, held_quarter(second));
  fem::PairOptions options;
  options.gap = [&](const VectorXd &x) { return sagitta(R1, x[0]) + sagitta(R2, x[0]); };
  return fem::pair_bodies({&slave, {}, Vector2d(0, -R1)}, upside_down(master, R2), {master_moves_down()}, options);
}
}  // namespace

double line_load_at(const double R1, const double R2, const Material &material, const double half_width,
                    const double approach)
{
  contact::ActiveSet solver(two_discs(R1, R2, material, half_width, half_width).problem);
  return 2 * solver.solve(prescribed(approach)).resultant[0];  // half of the width is meshed
}

namespace {
std::vector<Check> line_pair(const double R1, const double R2, const Material &material,
                             const std::vector<LineLoad> &loads, const bool only_tangent)
{
  const auto pair = two_discs(R1, R2, material, loads.front().b, loads.back().b);
  contact::ActiveSet solver(pair.problem);
  std::vector<Check> checks;
  for (const LineLoad &load : loads) {
    const contact::State state = solver.solve(by_resultant(0.5 * load.q));  // half of the width is meshed
    const Ellipse e            = fitted_ellipse(pair, state);
    const std::string where    = fmt::format(", q {:g} N/mm", load.q / N_per_mm);
    if (!only_tangent) {
      checks.push_back(relative("half width" + where, "mm", e.half_width / mm, load.b / mm, 0.005));
      checks.push_back(relative("peak pressure" + where, "MPa", e.peak / MPa, load.p0 / MPa, 0.005));
      checks.push_back(relative("approach" + where, "um", state.motion[0] / um, load.approach / um, 0.003));
    }
    checks.push_back(
        relative("dq/d(approach)" + where, "N/mm2", 2 / state.compliance(0, 0) / 1e6, load.tangent / 1e6, 0.005));
  }
  add_identities(checks, solver, solver.solve(by_resultant(0.5 * loads.back().q)));
  return checks;
}

// One disc between two rigid plates; both contacts and both halves are alike.
std::vector<Check> disc(const double R, const double q, const double b, const double p0, const double compression)
{
  const auto body  = disc_section(R, b, b, 24, steel);
  const auto slave = condensed_patch(body, held_quarter(body));
  fem::PairOptions options;
  options.gap     = [&](const VectorXd &x) { return sagitta(R, x[0]); };
  const auto pair = fem::pair_with_rigid({&slave, {}, Vector2d(0, -R)}, {master_moves_down()}, options);
  contact::ActiveSet solver(pair.problem);
  const contact::State state = solver.solve(by_resultant(0.5 * q));
  const Ellipse e            = fitted_ellipse(pair, state);
  std::vector<Check> checks{
      relative("half width", "mm", e.half_width / mm, b / mm, 0.005),
      relative("peak pressure", "MPa", e.peak / MPa, p0 / MPa, 0.005),
      relative("diametral compression", "um", 2 * state.motion[0] / um, compression / um, 0.003),
  };
  add_identities(checks, solver, state);
  return checks;
}

struct Cgs1 {
  Ellipse ellipse;
  double depth;  // m, u_y of the top of the block on its axis
};

Cgs1 cgs1(const double F, const double a, std::vector<Check> &identities)
{
  const double R = 50 * mm;
  const Material soft{70e9, 0.3, 2700};
  const auto cylinder = disc_section(R, a, a, 24, steel);
  const double patch  = 1.25 * a;
  const int n_patch   = 24;
  const ScratchFile file("cgs1");
  meshes::BlockGrid grid;
  grid.x = meshes::mesh_lines({patch, n_patch, 0, 1.25, 100 * mm});
  for (const double depth : meshes::mesh_lines({0, 0, patch / n_patch, 1.25, 200 * mm}))
    grid.y.insert(grid.y.begin(), -depth);
  grid.patch_x = patch;
  const fem::SectionBody block(meshes::mesh_block(grid, file.path), soft, 2, Section::plane_strain);
  const auto slave = condensed_patch(block, held_like_a_half_space(block));

  // Half cylinder: free on its cut plane but for one pin against rigid motion, and loaded there uniformly.
  std::vector<char> held(cylinder.stiffness().rows(), 0);
  for (const int node : cylinder.group("symmetry.x"))
    held[2 * node] = 1;
  const auto &cut = cylinder.group("symmetry.y");
  for (const int node : cut)
    if (std::abs(cylinder.nodes()(node, 0)) < 1e-9 * R)
      held[2 * node + 1] = 1;
  const auto master       = condensed_patch(cylinder, held);
  const Surface cut_line  = cylinder.surface("symmetry.y");
  fem::DrivenMode descent = master_moves_down();
  descent.master_load =
      fem::load_on(cut_line, fem::pressure_load(cut_line, [&](const VectorXd &) { return 1 / R; }),
                   cylinder.stiffness().rows());
  fem::PairOptions options;
  options.gap     = [&](const VectorXd &x) { return sagitta(R, x[0]); };
  const auto pair = fem::pair_bodies({&slave}, upside_down(master, R), {descent}, options);
  contact::ActiveSet solver(pair.problem);
  const contact::State state = solver.solve(by_resultant(0.5 * F));
  const VectorXd field       = slave.displacement(pair.slave_forces(state.nodal));
  Cgs1 out{fitted_ellipse(pair, state), 0};
  for (const int node : block.group("patch"))
    if (block.nodes()(node, 0) < 1e-9)
      out.depth = field[2 * node + 1];
  // The pin of the floating cylinder carries nothing: contact and load balance.
  const auto load          = fem::LoadCase{descent.master_load.force * state.resultant[0], {}};
  const VectorXd on_master = master.displacement(pair.master_forces(state.nodal), load);
  double carried           = 0;
  const VectorXd reactions = master.reactions(on_master, load);
  for (const int node : cut)
    carried += std::abs(reactions[2 * node + 1]);
  identities.push_back({"force in the pin of the floating cylinder / load", "-", carried / state.resultant[0],
                        1e-9, 0, Judged::at_most});
  add_identities(identities, solver, state);
  return out;
}

// A half plane over its whole width, so that it can be sheared: rectangle of `extent` to each side, base clamped.
fem::SectionBody whole_half_plane(const double patch, const int n_patch, const double extent)
{
  const ScratchFile file("half-plane");
  const auto half = meshes::mesh_lines({patch, n_patch, 0, 1.4, extent});
  meshes::BlockGrid grid;
  for (auto x = half.rbegin(); x != half.rend(); ++x)
    grid.x.push_back(-*x);
  grid.x.insert(grid.x.end(), half.begin() + 1, half.end());
  for (const double depth : meshes::mesh_lines({0, 0, patch / n_patch, 1.4, extent}))
    grid.y.insert(grid.y.begin(), -depth);
  grid.patch_from_x = -patch;
  grid.patch_x      = patch;
  return fem::SectionBody(meshes::mesh_block(grid, file.path), steel, 2, Section::plane_strain);
}
}  // namespace

std::vector<Check> cattaneo_line_section()
{
  const double b = 0.742790 * mm, R = 50 * mm, q = 1000 * N_per_mm, mu = 0.3;
  fem::SurfaceOptions tangential;
  tangential.direction  = Vector2d(0, 1);
  tangential.tangential = true;
  const auto condensed  = [&](const fem::SectionBody &body) {
    std::vector<char> held(body.stiffness().rows(), 0);
    for (const int node : body.group("bottom"))
      held[2 * node] = held[2 * node + 1] = 1;
    return fem::CondensedSurface(body.stiffness(), 2, held, body.surface("patch"), tangential);
  };
  const auto first = whole_half_plane(1.2 * b, 36, 100 * b), second = whole_half_plane(1.2 * b, 29, 100 * b);
  const auto slave = condensed(first), master = condensed(second);
  fem::DrivenMode sideways;
  sideways.master.translation = Vector2d(1, 0);
  fem::PairOptions options;
  options.gap = [&](const VectorXd &x) { return x[0] * x[0] / (2 * R); };
  const auto pair =
      fem::pair_with_friction({&slave}, upside_down(master), {master_moves_down(), sideways}, mu, options);
  contact::FrictionSolver solver(pair.problem);
  const Eigen::Index n = pair.coupling.weight.size();
  const VectorXd x     = (pair.coupling.mean * pair.coupling.points).col(0);
  std::vector<Check> checks;
  double residual = 0;
  struct Load {
    double ratio, c, middle, edge;  // Q / (mu P), c / b, tau(0) and tau(c) in MPa
  };
  solver.advance({Vector2d(q, 0), {}});
  for (const Load &load : {Load{0.25, 0.866025, 34.448, 128.560}, Load{0.5, 0.707107, 75.309, 181.811}}) {
    const auto &state = solver.advance({Vector2d(q, load.ratio * mu * q), {}});
    residual          = std::max(residual, state.residual);
    const VectorXd p  = state.nodal.head(n).cwiseQuotient(pair.coupling.weight),
                   t  = state.nodal.tail(n).cwiseQuotient(pair.coupling.weight).cwiseAbs();
    // Where it sticks, mu p - tau is an ellipse of half width c; both ellipses are finer than the grid.
    VectorXd spare = VectorXd::Zero(n);
    for (Eigen::Index i = 0; i < n; ++i)
      if (state.status[i] == contact::Status::stick)
        spare[i] = mu * p[i] - t[i];
    const Ellipse whole = fitted_ellipse(x, p), lacking = fitted_ellipse(x, spare);
    const double c   = lacking.half_width;
    const auto where = fmt::format(", Q/(mu P) {:g}", load.ratio);
    checks.push_back(relative("c/b" + where, "-", c / whole.half_width, load.c, 0.005));
    checks.push_back(
        relative("tau(0)" + where, "MPa", (mu * whole.peak - lacking.peak) / MPa, load.middle, 0.005));
    checks.push_back(relative("tau(c)" + where, "MPa",
                              mu * whole.peak * std::sqrt(1 - std::pow(c / whole.half_width, 2)) / MPa, load.edge,
                              0.005));
  }
  checks.push_back(
      {"residual of the conditions of contact and friction", "-", residual, 1e-12, 0, Judged::at_most});
  return checks;
}

std::vector<Check> cgs1_small()
{
  std::vector<Check> identities;
  const Cgs1 small = cgs1(350 * N_per_mm, 0.62146 * mm, identities);
  std::vector<Check> checks{
      relative("peak pressure", "MPa", small.ellipse.peak / MPa, 358.54, 0.005),
      relative("half width", "mm", small.ellipse.half_width / mm, 0.62146, 0.01),
  };
  checks.insert(checks.end(), identities.begin(), identities.end());
  return checks;
}

std::vector<Check> cgs1_depth()
{
  std::vector<Check> identities;
  const Cgs1 full = cgs1(35000 * N_per_mm, 6.2146 * mm, identities);
  std::vector<Check> checks{
      reported("u_y at the top of the block, on its axis", "mm", full.depth / mm, -1.308),
      reported("peak pressure", "MPa", full.ellipse.peak / MPa, 3585.36),
      reported("half width", "mm", full.ellipse.half_width / mm, 6.2146),
  };
  checks.insert(checks.end(), identities.begin(), identities.end());
  return checks;
}

std::vector<Check> line_200_650()
{
  const std::vector<LineLoad> loads{
      {200 * N_per_mm, 0.5810 * mm, 219.16 * MPa, 8.074 * um, 26587e6},
      {1000 * N_per_mm, 1.2991 * mm, 490.05 * MPa, 35.931 * um, 30146e6},
      {5000 * N_per_mm, 2.9049 * mm, 1095.78 * MPa, 157.453 * um, 34804e6},
  };
  return line_pair(200 * mm, 650 * mm, steel, loads, false);
}

std::vector<Check> line_210_725()
{
  const Material material{210e9, 0.28, 7700};
  const LineLoad load{697.29 * N_per_mm, 1.1264 * mm, 394.08 * MPa, 26.237 * um, 28708e6};
  return line_pair(210 * mm, 725 * mm, material, {load}, true);
}

std::vector<Check> disc_r10()
{
  return disc(10 * mm, 500 * N_per_mm, 0.166093 * mm, 1916.457 * MPa, 13.7495 * um);
}

std::vector<Check> disc_r50()
{
  return disc(50 * mm, 1000 * N_per_mm, 0.525232 * mm, 1212.074 * MPa, 30.0268 * um);
}
}  // namespace mill::verify
