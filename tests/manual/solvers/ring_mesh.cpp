#include "tests/manual/solvers/ring_mesh.h"
#include "core/base/errors.h"
#include "meshes/common/structured.h"
#include "meshes/common/write_mesh.h"
#include "meshes/gmsh/gmsh_scope.h"
#include "meshes/gmsh/roll_section.h"
#include <algorithm>
#include <cmath>
#include <gmsh.h>
#include <map>

namespace mill::meshes {
MeshFile mesh_ring(const std::vector<double> &radii, const int n_angle, const std::string &path)
{
  StructuredGrid grid;
  grid.n = {int(radii.size()), n_angle + 1};
  for (int j = 0; j <= n_angle; ++j) {
    const double theta = 0.5 * M_PI * j / n_angle;
    for (const double r : radii)  // the ends exactly on the axes
      grid.points.push_back({j == n_angle ? 0 : r * std::cos(theta), j == 0 ? 0 : r * std::sin(theta), 0});
  }
  grid.group = [](const int direction, const int side, const std::array<double, 3> &) -> std::string {
    const char *names[2][2] = {{"inner", "outer"}, {"symmetry.y", "symmetry.x"}};
    return names[direction][side];
  };
  return write_grid(grid, path);
}

namespace {
// In the current Gmsh model; the contact patch and its fineness besides.
MeshFile disc_in_gmsh(const double radius, const SectionSize &size)
{
  RollGeometry disc;
  disc.radius                    = radius;
  const SectionSurfaces surfaces = add_section(disc, size);
  gmsh::model::geo::synchronize();
  std::vector<int> tags = surfaces.core;
  tags.insert(tags.end(), surfaces.rim.begin(), surfaces.rim.end());
  gmsh::model::addPhysicalGroup(2, tags, 1);
  const double patch = patch_half_width(size), small = 1e-6 * size.first_element;
  std::map<std::string, std::vector<int>> members;
  gmsh::vectorpair curves;
  gmsh::model::getEntities(curves, 1);
  for (const auto &curve : curves) {
    std::vector<int> up, down;
    gmsh::model::getAdjacencies(1, curve.second, up, down);
    if (up.size() != 1)
      continue;
    double x0, y0, z0, x1, y1, z1;
    gmsh::model::getBoundingBox(1, curve.second, x0, y0, z0, x1, y1, z1);
    members[x1 < small                ? "symmetry.x"
            : y1 < small              ? "symmetry.y"
            : x1 < patch * (1 + 1e-6) ? "patch"
                                      : "rim"]
        .push_back(curve.second);
  }
  MeshFile mesh;
  for (const auto &[name, lines] : members) {
    const int id      = int(mesh.groups.size()) + 1;
    mesh.groups[name] = id;
    gmsh::model::addPhysicalGroup(1, lines, id);
    gmsh::model::setPhysicalName(1, id, name);
  }
  gmsh::model::mesh::generate(2);
  std::vector<int> kinds;
  gmsh::model::mesh::getElementTypes(kinds, 2);
  std::vector<std::size_t> elements, nodes;
  const int quad = gmsh::model::mesh::getElementType("quadrangle", 1);
  gmsh::model::mesh::getElementsByType(quad, elements, nodes);
  std::vector<double> jacobians, determinants, coordinates;
  gmsh::model::mesh::getJacobians(quad, {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}, jacobians, determinants,
                                  coordinates);
  mesh.smallest_jacobian = 1;
  for (std::size_t i = 0; i < determinants.size(); i += 4) {
    const auto [low, high] = std::minmax_element(determinants.begin() + i, determinants.begin() + i + 4);
    mesh.smallest_jacobian = std::min(mesh.smallest_jacobian, *high > 0 ? *low / *high : -1.);
  }
  if (members.size() != 4 || kinds.size() != 1 || mesh.smallest_jacobian <= 0)
    throw SolverError({"mesh of a disc failed its quality check",
                       kinds.size() != 1 ? "it has other elements than quadrilaterals" : "an element is inverted",
                       "a patch that is wide for its circle", "make the patch narrower than a tenth of the radius",
                       ""});
  std::sort(nodes.begin(), nodes.end());
  mesh.n_nodes            = int(std::unique(nodes.begin(), nodes.end()) - nodes.begin());
  mesh.n_cells            = int(elements.size());
  mesh.contact_element    = size.first_element;
  mesh.contact_half_width = patch;
  return mesh;
}
}  // namespace

MeshFile mesh_disc(const double radius, const SectionSize &size, const std::string &path)
{
  MeshFile mesh;
  write_mesh(path, [&](const std::string &aside) {
    const GmshScope gmsh_is_open;
    mesh = disc_in_gmsh(radius, size);
    return write_model(aside);
  });
  mesh.path = path;
  return mesh;
}
}  // namespace mill::meshes
