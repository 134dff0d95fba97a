#include "meshes/roll/roll.h"
#include "core/case/errors.h"
#include "meshes/common/gmsh_scope.h"
#include "meshes/common/write_mesh.h"
#include "meshes/roll/plain_section.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gmsh.h>

namespace mill::meshes {
namespace {
namespace geo = gmsh::model::geo;

const std::vector<std::string> group_names{"contact", "symmetry.x", "symmetry.y", "symmetry.z",
                                           "barrel",  "neck",       "shoulder",   "end"};

// Volumes between z = z0 and the sum of the layers above it, from the given surfaces; returns the surfaces on top.
std::vector<int> extrude_along_roll(const std::vector<int> &surfaces, const std::vector<double> &layers)
{
  gmsh::vectorpair from, to;
  for (const int surface : surfaces)
    from.push_back({2, surface});
  double length = 0;
  std::vector<double> heights;
  for (const double layer : layers)
    heights.push_back(length += layer);
  for (double &height : heights)
    height /= length;
  geo::extrude(from, 0, 0, length, to, std::vector<int>(layers.size(), 1), heights, true);
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
}  // namespace

std::vector<double> graded_layers(const double length, const double end_layer, const double growth,
                                  const double largest)
{
  std::vector<double> layers;
  double sum = 0;
  for (double h = std::min(end_layer, length); sum < length * (1 - 1e-9); h = std::min(h * growth, largest)) {
    layers.push_back(h);
    sum += h;
  }
  // The last layer rarely fits: share the misfit among the thick ones, so that the thin ones keep their size.
  double movable     = 0;
  const double limit = 0.25 * layers.back();
  for (const double h : layers)
    movable += h >= limit ? h : 0;
  for (double &h : layers)
    if (h >= limit)
      h *= 1 + (length - sum) / movable;
  std::reverse(layers.begin(), layers.end());
  return layers;
}

MeshFile known_mesh(const std::string &path, const RollGeometry &geometry)
{
  MeshFile mesh;
  mesh.path     = path;
  mesh.geometry = geometry;
  mesh.unit     = geometry.radius;
  for (std::size_t i = 0; i < group_names.size(); ++i)
    if (geometry.neck_length > 0 || (group_names[i] != "neck" && group_names[i] != "shoulder"))
      mesh.groups[group_names[i]] = int(i) + 1;
  return mesh;
}

namespace {
// A ratio of lengths to 2^-40 of itself, so that one drawing gives one mesh, bit by bit, in metres and in
// millimetres.
double rounded(const double ratio)
{
  int exponent          = 0;
  const double mantissa = std::frexp(ratio, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, 40)), exponent - 40);
}

// Lengths in units of the radius.  Rounding then is the same whatever unit or size the roll is given in.
RollGeometry by_radius(RollGeometry g)
{
  const double unit = g.radius;
  each_member([&](const char *, double &length) { length = rounded(length / unit); }, g);
  return g;
}

RollMeshSize by_radius(RollMeshSize size, const double radius)
{
  for (double *length : {&size.section.first_element, &size.end_layer, &size.largest_layer, &size.break_at})
    *length = rounded(*length / radius);
  return size;
}
}  // namespace

RollMeshSize vibration_mesh_size(const RollGeometry &geometry, const int elements_per_radius)
{
  RollMeshSize size;
  size.plain_elements = elements_per_radius;
  size.largest_layer  = geometry.radius / elements_per_radius;
  size.end_layer      = 0.15 * size.largest_layer;
  size.layer_growth   = 1.5;
  return size;
}

MeshFile mesh_roll(const std::string &name, const RollGeometry &in_metres, const RollMeshSize &size_in_metres,
                   const std::string &path)
{
  const RollGeometry geometry = by_radius(in_metres);
  const RollMeshSize size     = by_radius(size_in_metres, in_metres.radius);
  const GmshScope gmsh_is_open;
  const bool plain   = size.plain_elements > 0;
  const double patch = plain ? plain_contact_half_width(geometry.radius) : patch_half_width(size.section);
  const SectionSurfaces surfaces =
      plain ? add_plain_section(geometry, size.plain_elements) : add_section(geometry, size.section);

  // Layers are thin where the contact ends: at the barrel end, or where the shorter barrel ends.
  const double facing = geometry.contact_half_length > 0 ? geometry.contact_half_length : geometry.half_length;
  const auto graded   = [&](const double length) {
    return graded_layers(length, size.end_layer, size.layer_growth, size.largest_layer);
  };
  auto layers = graded(facing);
  if (size.break_at > 0 && size.break_at < facing) {
    layers          = graded(size.break_at);
    const auto half = graded(0.5 * (facing - size.break_at));
    layers.insert(layers.end(), half.rbegin(), half.rend());
    layers.insert(layers.end(), half.begin(), half.end());
  }
  auto rim      = extrude_along_roll(surfaces.rim, layers);
  auto shoulder = extrude_along_roll(surfaces.core, layers);
  if (geometry.half_length - facing > 1e-9) {
    layers = graded_layers(geometry.half_length - facing, size.end_layer, size.layer_growth, size.largest_layer);
    std::reverse(layers.begin(), layers.end());
    extrude_along_roll(rim, layers);
    shoulder = extrude_along_roll(shoulder, layers);
  }
  if (geometry.neck_length > 0) {
    auto neck = graded_layers(geometry.neck_length, std::max(size.end_layer, 0.05 * geometry.neck_radius),
                              1.3 * size.layer_growth, size.largest_layer * 1.5);
    std::reverse(neck.begin(), neck.end());  // thin layers at the shoulder
    extrude_along_roll(shoulder, neck);
  }
  geo::synchronize();

  MeshFile mesh = known_mesh(path, in_metres);
  gmsh::vectorpair volumes, faces;
  gmsh::model::getEntities(volumes, 3);
  gmsh::model::getEntities(faces, 2);
  std::vector<int> volume_tags;
  for (const auto &volume : volumes)
    volume_tags.push_back(volume.second);
  gmsh::model::addPhysicalGroup(3, volume_tags, 1);
  std::map<std::string, std::vector<int>> members;
  for (const auto &face : faces)
    members[group_of(face.second, geometry, patch)].push_back(face.second);
  for (const auto &[group, id] : mesh.groups) {
    if (members[group].empty())
      throw SolverError({"mesh of the " + name + ": no face belongs to the group " + group, "", "", "", ""});
    gmsh::model::addPhysicalGroup(2, members[group], id);
    gmsh::model::setPhysicalName(2, id, group);
  }
  gmsh::model::mesh::generate(3);

  const int hexahedron = gmsh::model::mesh::getElementType("hexahedron", 1);
  std::vector<std::size_t> elements, nodes;
  gmsh::model::mesh::getElementsByType(hexahedron, elements, nodes);
  std::vector<int> kinds;
  gmsh::model::mesh::getElementTypes(kinds, 3);
  mesh.smallest_jacobian = elements.empty() ? -1 : smallest_jacobian(hexahedron);
  if (kinds.size() != 1 || mesh.smallest_jacobian <= 0)
    throw SolverError(
        {"mesh of the " + name + " failed its quality check",
         kinds.size() != 1 ? "it has other elements than hexahedra" : "an element is inverted",
         "a diameter, neck and contact half width that do not fit into one section",
         "check the diameters and lengths of the " + name +
             " (a neck of almost the barrel's diameter leaves no room) and contact.*.elements_per_half_width",
         ""});
  std::sort(nodes.begin(), nodes.end());
  mesh.n_nodes            = int(std::unique(nodes.begin(), nodes.end()) - nodes.begin());
  mesh.n_cells            = int(elements.size());
  mesh.contact_element    = size_in_metres.section.first_element;
  mesh.contact_half_width = patch * in_metres.radius;
  write_mesh(path);
  return mesh;
}
}  // namespace mill::meshes
