#include "meshes/gmsh/gmsh_mesher.h"
#include "meshes/gmsh/gmsh_scope.h"
#include "meshes/gmsh/roll_section.h"
#include <algorithm>
#include <gmsh.h>

namespace mill::meshes {
namespace {
namespace geo = gmsh::model::geo;

// Volumes between z = z0 and the sum of the layers above it, from the given surfaces; returns the surfaces on top.
std::vector<int> extrude_along_roll(const std::vector<int> &surfaces, const std::vector<double> &layers)
{
  gmsh::vectorpair from, to;
  for (const int surface : surfaces)
    from.push_back({2, surface});
  const StackedLayers stack = stacked(layers);
  geo::extrude(from, 0, 0, stack.length, to, stack.elements, stack.heights, true);
  // Gmsh lists, per surface, the one on top, the volume, then the sides.
  std::vector<int> top;
  for (std::size_t i = 0; i + 1 < to.size(); ++i)
    if (to[i].first == 2 && to[i + 1].first == 3)
      top.push_back(to[i].second);
  return top;
}

// The group a boundary surface belongs to, from its bounding box; empty for a surface inside the body.
std::string group_of(const int surface, const RollGeometry &g, const double patch)
{
  std::vector<int> volumes, curves;
  gmsh::model::getAdjacencies(2, surface, volumes, curves);
  if (volumes.size() != 1)
    return "";
  double x0, y0, z0, x1, y1, z1;
  gmsh::model::getBoundingBox(2, surface, x0, y0, z0, x1, y1, z1);
  const double small = 1e-6 * patch;  // boxes of the built-in kernel are exact up to Geometry.Tolerance
  if (x1 < small)
    return "symmetry.x";
  if (y1 < small)
    return "symmetry.y";
  if (z1 < small)
    return "symmetry.z";
  if (z1 - z0 < small)
    return z0 > g.half_length + small || g.neck_length == 0 ? "end" : "shoulder";
  if (z0 > g.half_length - small)
    return "neck";
  const double facing = g.contact_half_length > 0 ? g.contact_half_length : g.half_length;
  return x1 < patch * (1 + 1e-6) && x0 < small && z1 < facing + small ? "contact" : "barrel";
}

// Smallest over all elements of the smallest corner Jacobian over the largest: 1 for a brick, <= 0 when inverted.
double smallest_jacobian(const int hexahedron)
{
  const std::vector<double> corners{-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                    -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1};
  std::vector<double> jacobians, determinants, coordinates;
  gmsh::model::mesh::getJacobians(hexahedron, corners, jacobians, determinants, coordinates);
  double smallest = 1;
  for (std::size_t i = 0; i < determinants.size(); i += 8) {
    const auto [low, high] = std::minmax_element(determinants.begin() + i, determinants.begin() + i + 8);
    smallest               = std::min(smallest, *high > 0 ? *low / *high : -1.);
  }
  return smallest;
}

// Barrel and neck, from the section at mid-length.
void extrude_roll(const SectionSurfaces &section, const RollLayers &layers)
{
  auto rim      = extrude_along_roll(section.rim, layers.facing);
  auto shoulder = extrude_along_roll(section.core, layers.facing);
  if (!layers.beyond.empty()) {
    extrude_along_roll(rim, layers.beyond);
    shoulder = extrude_along_roll(shoulder, layers.beyond);
  }
  if (!layers.neck.empty())
    extrude_along_roll(shoulder, layers.neck);
  geo::synchronize();
}

// Names the boundary; returns a group without faces, or "".
std::string name_groups(const RollDrawing &roll)
{
  gmsh::vectorpair volumes, faces;
  gmsh::model::getEntities(volumes, 3);
  gmsh::model::getEntities(faces, 2);
  std::vector<int> volume_tags;
  for (const auto &volume : volumes)
    volume_tags.push_back(volume.second);
  gmsh::model::addPhysicalGroup(3, volume_tags, 1);
  std::map<std::string, std::vector<int>> members;
  for (const auto &face : faces)
    members[group_of(face.second, roll.geometry, roll.patch)].push_back(face.second);
  for (const auto &[group, id] : roll.groups) {
    if (members[group].empty())
      return group;
    gmsh::model::addPhysicalGroup(2, members[group], id);
    gmsh::model::setPhysicalName(2, id, group);
  }
  return "";
}
}  // namespace

Meshed gmsh_mesh_roll(const RollDrawing &roll, const std::string &path)
{
  const GmshScope gmsh_is_open;
  extrude_roll(roll.plain_elements > 0 ? add_plain_section(roll.geometry, roll.plain_elements)
                                       : add_section(roll.geometry, roll.section),
               roll.layers);
  Meshed out;
  out.groups      = roll.groups;
  out.empty_group = name_groups(roll);
  if (!out.empty_group.empty())
    return out;
  gmsh::model::mesh::generate(3);

  const int hexahedron = gmsh::model::mesh::getElementType("hexahedron", 1);
  std::vector<std::size_t> elements, nodes;
  gmsh::model::mesh::getElementsByType(hexahedron, elements, nodes);
  std::vector<int> kinds;
  gmsh::model::mesh::getElementTypes(kinds, 3);
  out.one_kind          = kinds.size() == 1;
  out.smallest_jacobian = elements.empty() ? -1 : smallest_jacobian(hexahedron);
  std::sort(nodes.begin(), nodes.end());
  out.n_nodes = int(std::unique(nodes.begin(), nodes.end()) - nodes.begin());
  out.n_cells = int(elements.size());
  if (out.one_kind && out.smallest_jacobian > 0)
    out.not_written = write_model(path);
  return out;
}
}  // namespace mill::meshes
