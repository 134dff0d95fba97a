#include "meshes/gmsh/gmsh_mesher.h"
#include "meshes/gmsh/gmsh_scope.h"
#include <algorithm>
#include <gmsh.h>

namespace mill::meshes {
namespace {
namespace geo = gmsh::model::geo;

// Extrudes lines along z; returns the lines at the far side.
std::vector<int> extrude_lines(const std::vector<int> &lines, const std::vector<double> &layers)
{
  gmsh::vectorpair from, to;
  for (const int line : lines)
    from.push_back({1, line});
  const StackedLayers stack = stacked(layers);
  geo::extrude(from, 0, stack.length, 0, to, stack.elements, stack.heights, true);
  std::vector<int> far;
  for (std::size_t i = 0; i + 1 < to.size(); ++i)
    if (to[i].first == 1 && to[i + 1].first == 2)
      far.push_back(to[i].second);
  return far;
}

std::string line_group_of(const int line, const MeridianDrawing &roll)
{
  const RollGeometry &g = roll.geometry;
  std::vector<int> surfaces, points;
  gmsh::model::getAdjacencies(1, line, surfaces, points);
  if (surfaces.size() != 1)
    return "";
  double r0, z0, r1, z1, unused;
  gmsh::model::getBoundingBox(1, line, r0, z0, unused, r1, z1, unused);
  const double small  = 1e-7 * g.radius;  // far above Geometry.Tolerance, far below any element
  const double facing = g.contact_half_length > 0 ? g.contact_half_length : g.half_length;
  if (r1 < roll.radii.front() + small)
    return "axis";
  if (z1 < small)
    return "symmetry.z";
  if (z1 - z0 < small)
    return g.neck_length > 0 && z0 < g.half_length + small ? "shoulder" : "end";
  if (z0 > g.half_length - small)
    return "neck";
  return z1 < facing + small ? "contact" : "barrel";
}

// The section from the lines along r at mid-length.
void extrude_section(const MeridianDrawing &roll)
{
  const std::vector<double> &r = roll.radii;
  const RollGeometry &g        = roll.geometry;
  std::vector<int> core, rim;
  int last = geo::addPoint(r.front(), 0, 0);
  for (std::size_t i = 1; i < r.size(); ++i) {
    const int next = geo::addPoint(r[i], 0, 0), line = geo::addLine(last, next);
    geo::mesh::setTransfiniteCurve(line, 2);
    (g.neck_length > 0 && r[i] < g.neck_radius * (1 + 1e-9) ? core : rim).push_back(line);
    last = next;
  }
  rim  = extrude_lines(rim, roll.layers.facing);
  core = extrude_lines(core, roll.layers.facing);
  if (!roll.layers.beyond.empty()) {
    extrude_lines(rim, roll.layers.beyond);
    core = extrude_lines(core, roll.layers.beyond);
  }
  if (!roll.layers.neck.empty())
    extrude_lines(core, roll.layers.neck);
  geo::synchronize();
}

// Names the boundary; ids from 1 in alphabetical order.
std::map<std::string, int> named_groups(const MeridianDrawing &roll)
{
  gmsh::vectorpair surfaces, lines;
  gmsh::model::getEntities(surfaces, 2);
  gmsh::model::getEntities(lines, 1);
  std::vector<int> tags;
  for (const auto &surface : surfaces)
    tags.push_back(surface.second);
  gmsh::model::addPhysicalGroup(2, tags, 1);
  std::map<std::string, std::vector<int>> members;
  for (const auto &line : lines)
    members[line_group_of(line.second, roll)].push_back(line.second);
  members.erase("");  // lines inside
  std::map<std::string, int> groups;
  for (const auto &[group, of_group] : members) {
    const int id  = int(groups.size()) + 1;
    groups[group] = id;
    gmsh::model::addPhysicalGroup(1, of_group, id);
    gmsh::model::setPhysicalName(1, id, group);
  }
  return groups;
}
}  // namespace

Meshed gmsh_mesh_meridian(const MeridianDrawing &roll, const std::string &path)
{
  const GmshScope gmsh_is_open;
  extrude_section(roll);
  Meshed out;
  out.groups = named_groups(roll);
  gmsh::model::mesh::generate(2);

  std::vector<int> kinds;
  gmsh::model::mesh::getElementTypes(kinds, 2);
  const int quadrilateral = gmsh::model::mesh::getElementType("quadrangle", 1);
  out.one_kind            = kinds.size() == 1 && kinds[0] == quadrilateral;
  if (!out.one_kind)
    return out;
  std::vector<std::size_t> elements, nodes;
  gmsh::model::mesh::getElementsByType(quadrilateral, elements, nodes);
  std::sort(nodes.begin(), nodes.end());
  out.n_nodes     = int(std::unique(nodes.begin(), nodes.end()) - nodes.begin());
  out.n_cells     = int(elements.size());
  out.not_written = write_model(path);
  return out;
}
}  // namespace mill::meshes
