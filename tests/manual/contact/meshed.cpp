#include "tests/manual/contact/meshed.h"
#include "core/base/errors.h"
#include "meshes/common/block.h"
#include "meshes/roll/contact_mesh_size.h"
#include "tests/manual/solvers/ring_mesh.h"
#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace mill::verify {
ScratchFile::ScratchFile(const std::string &name)
    : path((std::filesystem::temp_directory_path() /
            ("millstand-verify-" + std::to_string(::getpid()) + "-" + name + ".msh"))
               .string())
{
}
ScratchFile::~ScratchFile()
{
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
}

fem::SectionBody half_space_section(const GradedRectangle &size, const Material &material,
                                    const fem::Section section)
{
  const ScratchFile file("rectangle");
  const double element = size.patch / size.n_patch;
  meshes::BlockGrid grid;
  grid.x = meshes::mesh_lines({size.patch, size.n_patch, 0, size.growth, size.extent});
  for (const double depth : meshes::mesh_lines({0, 0, element, size.growth, size.extent}))
    grid.y.insert(grid.y.begin(), -depth);
  grid.patch_x = size.patch;
  return fem::SectionBody(meshes::mesh_block(grid, file.path), material, 2, section);
}

std::vector<char> held_like_a_half_space(const fem::SectionBody &body)
{
  std::vector<char> held(body.stiffness().rows(), 0);
  for (const int node : body.group("left"))
    held[2 * node] = 1;
  for (const int node : body.group("bottom"))
    held[2 * node] = held[2 * node + 1] = 1;
  return held;
}

fem::SectionBody disc_section(const double radius, const double smallest, const double largest,
                              const int per_half_width, const Material &material)
{
  const ScratchFile file("disc");
  meshes::SectionSize size = meshes::slab_contact_size(smallest, largest, per_half_width).section;
  size.far_growth          = 1.3;
  size.sector_elements     = 6;
  return fem::SectionBody(meshes::mesh_disc(radius, size, file.path), material, 2, fem::Section::plane_strain,
                          {{"patch", {0, 0}, radius}, {"rim", {0, 0}, radius}});
}

Ellipse fitted_ellipse(const Eigen::VectorXd &x, const Eigen::VectorXd &pressure)
{
  double edge = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (pressure[i] > 0)
      edge = std::max(edge, std::abs(x[i]));
  // No round share: no node of an even grid may sit on the limit, or rounding would decide whether it is included.
  const double limit = 0.9137 * edge;
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (Eigen::Index i = 0; i < x.size(); ++i)
    if (pressure[i] > 0 && std::abs(x[i]) < limit) {
      const double a = x[i] * x[i], b = pressure[i] * pressure[i];
      n += 1;
      sx += a;
      sy += b;
      sxx += a * a;
      sxy += a * b;
    }
  if (n < 3)
    throw SolverError({"ellipse: fewer than three nodes touch", "", "a mesh too coarse for the contact", "", ""});
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), top = (sy - slope * sx) / n;
  return {std::sqrt(top), std::sqrt(-top / slope)};
}

void add_identities(std::vector<Check> &checks, contact::ActiveSet &solver, const contact::State &state)
{
  // The curve has a corner where a node joins or leaves: the widest step without one.
  double ratio = 0;
  for (double step = 1e-4; step > 1e-8; step /= 10) {
    const auto low  = solver.solve({state.resultant * (1 - step), {}}),
               high = solver.solve({state.resultant * (1 + step), {}});
    ratio = (high.resultant[0] - low.resultant[0]) / (high.motion[0] - low.motion[0]) * state.compliance(0, 0);
    if (low.active == high.active)
      break;
  }
  checks.push_back({"tangent of the set / central difference", "-", ratio, 1, 1e-6});
  checks.push_back({"complementarity residual", "-", state.residual, 1e-12, 0, Judged::at_most});
}
fem::CondensedSurface condensed_patch(const fem::SectionBody &body, const std::vector<char> &held)
{
  fem::SurfaceOptions options;
  options.direction = Eigen::Vector2d(0, 1);
  return {body.stiffness(), 2, held, body.surface("patch"), options};
}

fem::PlacedBody upside_down(const fem::CondensedSurface &body, const double shift)
{
  return {&body, Eigen::Vector2d(1, -1).asDiagonal(), Eigen::Vector2d(0, shift)};
}

fem::DrivenMode master_moves_down()
{
  fem::DrivenMode mode;
  mode.master.translation = Eigen::Vector2d(0, -1);
  return mode;
}

contact::Loading by_resultant(const double value)
{
  return {Eigen::VectorXd::Constant(1, value), {}};
}
contact::Loading prescribed(const double value)
{
  return {Eigen::VectorXd::Constant(1, value), {1}};
}

Ellipse fitted_ellipse(const fem::BodyPair &pair, const contact::State &state)
{
  return fitted_ellipse(pair.points().col(0), pair.pressure(state.nodal));
}

std::vector<char> held_quarter(const fem::SectionBody &disc)
{
  std::vector<char> held(disc.stiffness().rows(), 0);
  for (const int node : disc.group("symmetry.x"))
    held[2 * node] = 1;
  for (const int node : disc.group("symmetry.y"))
    held[2 * node + 1] = 1;
  return held;
}
}  // namespace mill::verify
