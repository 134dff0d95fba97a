#include "tests/manual/contact/round_sections.h"
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

// Two half spaces as cylinders of 2000 contact radii whose grids do not match; the curvature is in the gap.
struct RoundContact {
  fem::SectionBody first, second;
  fem::CondensedSurface slave, master;
  fem::BodyPair pair;

  RoundContact(const double a, const double relative_radius, const Material &material, const int n_slave,
               const int n_master)
      : first(half_space_section({1.1 * a, n_slave, 2000 * a, 1.35}, material, Section::axisymmetric)),
        second(half_space_section({1.1 * a, n_master, 2000 * a, 1.35}, material, Section::axisymmetric)),
        slave(condensed_patch(first, held_like_a_half_space(first))),
        master(condensed_patch(second, held_like_a_half_space(second)))
  {
    fem::PairOptions options;
    options.gap = [&](const VectorXd &x) { return x[0] * x[0] / (2 * relative_radius); };
    pair        = fem::pair_bodies({&slave}, upside_down(master), {master_moves_down()}, options);
  }
};

}  // namespace

std::vector<Check> sphere_flat()
{
  const RoundContact c(0.402073 * mm, 10 * mm, steel, 110, 80);
  contact::ActiveSet solver(c.pair.problem);
  const contact::State state = solver.solve(by_resultant(1000));
  const Ellipse e            = fitted_ellipse(c.pair, state);
  std::vector<Check> checks{
      relative("contact radius", "mm", e.half_width / mm, 0.402073, 0.005),
      relative("peak pressure", "MPa", e.peak / MPa, 2953.469, 0.01),
      relative("approach", "um", state.motion[0] / um, 16.1662, 0.005),
      relative("dF/d(approach)", "N/mm", 1 / state.compliance(0, 0) / 1e3, 92786, 0.005),
      {"unknowns", "-", double(c.slave.n_unknowns() + c.master.n_unknowns()), 100000, 0, Judged::at_most},
  };
  add_identities(checks, solver, state);
  return checks;
}

std::vector<Check> sphere_sphere()
{
  const Material material{20e9, 0.3, 1000};
  std::vector<Check> checks;
  struct Crush {
    double total, radius, peak;  // m, m, Pa
  };
  for (const Crush &crush : {Crush{4 * mm, 10 * mm, 2798.33 * MPa}, Crush{0.04 * mm, 1 * mm, 279.833 * MPa}}) {
    const RoundContact c(crush.radius, 25 * mm, material, 40, 30);
    contact::ActiveSet solver(c.pair.problem);
    const contact::State state = solver.solve(prescribed(crush.total));
    const Ellipse e            = fitted_ellipse(c.pair, state);
    const std::string where    = fmt::format(", crush {:g} mm", crush.total / mm);
    checks.push_back(relative("peak pressure" + where, "MPa", e.peak / MPa, crush.peak / MPa, 0.01));
    checks.push_back(relative("contact radius" + where, "mm", e.half_width / mm, crush.radius / mm, 0.01));
    if (crush.radius < 5 * mm) {
      add_identities(checks, solver, state);
    }
  }
  return checks;
}

std::vector<Check> flat_punch()
{
  const double a = 10 * mm, P = 10000, extent = 2000 * a, edge = 0.002 * a;
  const ScratchFile file("punch");
  meshes::BlockGrid grid;  // lines crowd at the edge of the punch, where the pressure is singular
  for (const double from_edge : meshes::mesh_lines({0, 0, edge, 1.25, a}))
    grid.x.insert(grid.x.begin(), a - from_edge);
  for (const double from_edge : meshes::mesh_lines({0, 0, edge, 1.25, extent - a}))
    if (from_edge > 0)
      grid.x.push_back(a + from_edge);
  for (const double depth : meshes::mesh_lines({0, 0, edge, 1.25, extent}))
    grid.y.insert(grid.y.begin(), -depth);
  grid.x.front() = 0;
  grid.patch_x   = a;
  const fem::SectionBody body(meshes::mesh_block(grid, file.path), steel, 2, Section::axisymmetric);
  const auto slave = condensed_patch(body, held_like_a_half_space(body));
  fem::PairOptions options;
  options.gap     = [](const VectorXd &) { return 0; };
  const auto pair = fem::pair_with_rigid({&slave}, {master_moves_down()}, options);
  contact::ActiveSet solver(pair.problem);
  const contact::State state   = solver.solve(by_resultant(P));
  const VectorXd pressure      = pair.pressure(state.nodal);
  const Eigen::MatrixXd points = pair.points();
  Eigen::Index centre          = 0;
  points.col(0).minCoeff(&centre);
  // Over the inner nine tenths; the singular edge itself has no value to compare.
  double worst = 0;
  for (Eigen::Index i = 0; i < pressure.size(); ++i)
    if (const double r = points(i, 0); r < 0.9 * a)
      worst = std::max(worst, std::abs(pressure[i] / (P / (2 * M_PI * a * std::sqrt(a * a - r * r))) - 1));
  std::vector<Check> checks{
      relative("approach", "um", state.motion[0] / um, 2.166667, 0.005),
      relative("dF/d(approach)", "N/mm", 1 / state.compliance(0, 0) / 1e3, 4615384.6, 0.005),
      relative("pressure in the middle", "MPa", pressure[centre] / MPa, 15.91549, 0.01),
      {"largest deviation of the pressure for r < 0.9 a", "-", worst, 0.01, 0, Judged::at_most},
      {"nodes that touch / nodes", "-", (state.nodal.array() > 0).count() / double(state.nodal.size()), 1, 0,
       Judged::absolute},
  };
  add_identities(checks, solver, state);
  return checks;
}
}  // namespace mill::verify
