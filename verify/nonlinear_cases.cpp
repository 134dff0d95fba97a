#include "fem/large_contact.h"
#include "meshes/block.h"
#include "verify/meshed.h"
#include <cmath>
#include <fmt/format.h>

// Large displacements and plasticity: contact inside a Newton iteration.
namespace mill::verify {
namespace {
using Eigen::VectorXd;

constexpr double mm = 1e-3, MPa = 1e6, N_per_mm = 1e3;

Check reported(const std::string &quantity, const std::string &unit, const double result, const double reference)
{
  return {quantity, unit, result, reference, 0, Judged::reported};
}

// ---- CGS-1
struct Cgs1 {
  fem::LargeContact contact;
  Ellipse ellipse;
  double depth;       // m, u_y of the top of the block on its axis
  double n_unknowns;  // of both bodies
};

// Steel half cylinder R 50 mm, loaded evenly on its cut plane and floating, on a block of 70 GPa, base clamped.
// @param a  m, half width to mesh for
Cgs1 cgs1(const double F, const double a, const int per_a, const fem::ElasticLaw law)
{
  const double R = 50 * mm;
  const Material steel{210e9, 0.3, 7850}, soft{70e9, 0.3, 2700};
  const auto cylinder = disc_section(R, a, a, per_a, steel);
  const double patch  = 1.25 * a;
  const ScratchFile file("cgs1-full");
  meshes::BlockGrid grid;
  grid.x = meshes::mesh_lines({patch, per_a, 0, 1.25, 100 * mm});
  for (const double depth : meshes::mesh_lines({0, 0, patch / per_a, 1.25, 200 * mm}))
    grid.y.insert(grid.y.begin(), -depth);
  grid.patch_x = patch;
  const fem::SectionBody block(meshes::mesh_block(grid, file.path), soft, 2, fem::Section::plane_strain);

  std::vector<char> held(cylinder.stiffness().rows(), 0);
  for (const int node : cylinder.group("symmetry.x"))
    held[2 * node] = 1;
  for (const int node : cylinder.group("symmetry.y"))
    if (std::abs(cylinder.nodes()(node, 0)) < 1e-9 * R)
      held[2 * node + 1] = 1;
  const Surface cut = cylinder.surface("symmetry.y");
  const VectorXd load =
      fem::load_on(cut, fem::pressure_load(cut, [&](const VectorXd &) { return 1 / R; }), cylinder.stiffness().rows())
          .force;
  Cgs1 out;
  out.contact = fem::press_together({&block, soft, held_like_a_half_space(block), "patch"},
                                    {&cylinder, steel, held, "patch", load, Eigen::Vector2d(1, -1).asDiagonal(),
                                     Eigen::Vector2d(0, R)},
                                    law, 0.5 * F);
  out.ellipse = fitted_ellipse(out.contact.points.col(0), out.contact.pressure);
  for (const int node : block.group("patch"))
    if (block.nodes()(node, 0) < 1e-9)
      out.depth = out.contact.slave[2 * node + 1];
  out.n_unknowns = double(block.stiffness().rows() + cylinder.stiffness().rows());
  return out;
}
}  // namespace
Cgs1 spike(double F, double a, int n, fem::ElasticLaw law) { return cgs1(F, a, n, law); }
}  // namespace mill::verify
