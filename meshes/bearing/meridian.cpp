#include "meshes/bearing/meridian.h"
#include "core/case/errors.h"
#include "meshes/common/gmsh_scope.h"
#include "meshes/roll/roll.h"
#include "meshes/common/write_mesh.h"
#include <algorithm>
#include <cmath>
#include <gmsh.h>
#include <vector>

namespace mill::meshes {
namespace {
namespace geo = gmsh::model::geo;

// Places along r: equal elements in the core, thinner and thinner ones towards the surface.
std::vector<double> radial_places(const RollGeometry &g, const MeridianSize &size)
{
  const double core    = g.neck_radius > 0 ? g.neck_radius : 0.5 * g.radius;
  const double largest = std::max(size.surface_element, 4 * g.radius * size.largest_share);
  const int n_core     = std::max(2, int(std::ceil(core / largest)));
  std::vector<double> r;
  for (int i = 0; i <= n_core; ++i)
    r.push_back(core * i / n_core);
  for (const double h : graded_layers(g.radius - core, size.surface_element, size.radial_growth, largest))
    r.push_back(r.back() + h);
  r.back() = g.radius;
  return r;
}

// Extrudes lines along z; returns the lines at the far side.
std::vector<int> extrude(const std::vector<int> &lines, const std::vector<double> &layers)
{
  gmsh::vectorpair from, to;
  for (const int line : lines)
    from.push_back({1, line});
  double length = 0;
  std::vector<double> heights;
  for (const double layer : layers)
    heights.push_back(length += layer);
  for (double &height : heights)
    height /= length;
  geo::extrude(from, 0, length, 0, to, std::vector<int>(layers.size(), 1), heights, true);
  std::vector<int> far;
  for (std::size_t i = 0; i + 1 < to.size(); ++i)
    if (to[i].first == 1 && to[i + 1].first == 2)
      far.push_back(to[i].second);
  return far;
}

std::string group_of(const int line, const RollGeometry &g)
{
  std::vector<int> surfaces, points;
  gmsh::model::getAdjacencies(1, line, surfaces, points);
  if (surfaces.size() != 1)
    return "";
  double r0, z0, r1, z1, unused;
  gmsh::model::getBoundingBox(1, line, r0, z0, unused, r1, z1, unused);
  const double small  = 1e-7 * g.radius;  // far above Geometry.Tolerance, far below any element
  const double facing = g.contact_half_length > 0 ? g.contact_half_length : g.half_length;
  if (r1 < small)
    return "axis";
  if (z1 < small)
    return "symmetry.z";
  if (z1 - z0 < small)
    return g.neck_length > 0 && z0 < g.half_length + small ? "shoulder" : "end";
  if (z0 > g.half_length - small)
    return "neck";
  return z1 < facing + small ? "contact" : "barrel";
}
}  // namespace

MeridianSize meridian_size(const double half_width)
{
  MeridianSize size;
  size.surface_element = 0.3 * half_width;
  size.end_layer       = 0.5 * half_width;
  return size;
}

MeridianSize refined(const MeridianSize &size)
{
  // Two elements for one: half the first, the square root of the ratio.
  MeridianSize fine    = size;
  fine.surface_element = size.surface_element / (1 + std::sqrt(size.radial_growth));
  fine.radial_growth   = std::sqrt(size.radial_growth);
  fine.end_layer       = size.end_layer / (1 + std::sqrt(size.layer_growth));
  fine.layer_growth    = std::sqrt(size.layer_growth);
  fine.largest_share   = 0.5 * size.largest_share;
  return fine;
}

MeshFile mesh_meridian(const std::string &name, const RollGeometry &g, const MeridianSize &size,
                       const std::string &path)
{
  const GmshScope gmsh_is_open;
  const std::vector<double> r = radial_places(g, size);
  std::vector<int> core, rim;
  int last = geo::addPoint(0, 0, 0);
  for (std::size_t i = 1; i < r.size(); ++i) {
    const int next = geo::addPoint(r[i], 0, 0), line = geo::addLine(last, next);
    geo::mesh::setTransfiniteCurve(line, 2);
    (g.neck_length > 0 && r[i] < g.neck_radius * (1 + 1e-9) ? core : rim).push_back(line);
    last = next;
  }
  const double facing = g.contact_half_length > 0 ? g.contact_half_length : g.half_length;
  const auto layers   = graded_layers(facing, size.end_layer, size.layer_growth, size.largest_share * facing);
  rim                 = extrude(rim, layers);
  core                = extrude(core, layers);
  if (g.half_length - facing > 1e-9) {
    auto beyond =
        graded_layers(g.half_length - facing, size.end_layer, size.layer_growth, size.largest_share * facing);
    std::reverse(beyond.begin(), beyond.end());
    extrude(rim, beyond);
    core = extrude(core, beyond);
  }
  if (g.neck_length > 0) {
    auto neck = graded_layers(g.neck_length, std::max(size.end_layer, 0.02 * g.neck_radius), size.layer_growth,
                              1.5 * size.largest_share * facing);
    std::reverse(neck.begin(), neck.end());  // thin layers at the shoulder
    extrude(core, neck);
  }
  geo::synchronize();

  MeshFile mesh;
  mesh.path     = path;
  mesh.geometry = g;
  gmsh::vectorpair surfaces, lines;
  gmsh::model::getEntities(surfaces, 2);
  gmsh::model::getEntities(lines, 1);
  std::vector<int> tags;
  for (const auto &surface : surfaces)
    tags.push_back(surface.second);
  gmsh::model::addPhysicalGroup(2, tags, 1);
  std::map<std::string, std::vector<int>> members;
  for (const auto &line : lines)
    members[group_of(line.second, g)].push_back(line.second);
  members.erase("");  // lines inside
  for (const auto &[group, of_group] : members) {
    const int id       = int(mesh.groups.size()) + 1;
    mesh.groups[group] = id;
    gmsh::model::addPhysicalGroup(1, of_group, id);
    gmsh::model::setPhysicalName(1, id, group);
  }
  gmsh::model::mesh::generate(2);

  std::vector<int> kinds;
  gmsh::model::mesh::getElementTypes(kinds, 2);
  const int quadrilateral = gmsh::model::mesh::getElementType("quadrangle", 1);
  if (kinds.size() != 1 || kinds[0] != quadrilateral)
    throw SolverError({"meridian mesh of the " + name + " has other elements than quadrilaterals", "",
                       "a neck that is as thick as the barrel", "check the diameters of the " + name, ""});
  std::vector<std::size_t> elements, nodes;
  gmsh::model::mesh::getElementsByType(quadrilateral, elements, nodes);
  std::sort(nodes.begin(), nodes.end());
  mesh.n_nodes         = int(std::unique(nodes.begin(), nodes.end()) - nodes.begin());
  mesh.n_cells         = int(elements.size());
  mesh.contact_element = size.surface_element;
  write_mesh(path);
  return mesh;
}
}  // namespace mill::meshes
