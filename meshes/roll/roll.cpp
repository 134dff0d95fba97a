#include "meshes/roll/roll.h"
#include "core/base/choice.h"
#include "core/base/errors.h"
#include "meshes/common/mesher.h"
#include "meshes/common/write_mesh.h"
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mill::meshes {
namespace {
// Groups of faces, in the order of their numbers in the file.
enum class FaceGroup { contact, symmetry_x, symmetry_y, symmetry_z, barrel, neck, shoulder, end };
constexpr auto words_of(FaceGroup)
{
  return choice_words<FaceGroup>("contact", "symmetry.x", "symmetry.y", "symmetry.z", "barrel", "neck", "shoulder",
                                 "end");
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
  for (const FaceGroup group : every<FaceGroup>())
    if (geometry.neck_length > 0 || (group != FaceGroup::neck && group != FaceGroup::shoulder))
      mesh.groups[word_of(group)] = int(group) + 1;
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

// Lengths in units of the radius.  Rounding then is the same for every unit and size of the roll.
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

// Layers are thin where the contact ends: at the barrel end, or where the shorter barrel ends.
RollLayers layers_of(const RollGeometry &geometry, const RollMeshSize &size)
{
  const double facing = geometry.contact_half_length > 0 ? geometry.contact_half_length : geometry.half_length;
  const auto graded   = [&](const double length) {
    return graded_layers(length, size.end_layer, size.layer_growth, size.largest_layer);
  };
  RollLayers out;
  out.facing = graded(facing);
  if (size.break_at > 0 && size.break_at < facing) {
    out.facing      = graded(size.break_at);
    const auto half = graded(0.5 * (facing - size.break_at));
    out.facing.insert(out.facing.end(), half.rbegin(), half.rend());
    out.facing.insert(out.facing.end(), half.begin(), half.end());
  }
  if (geometry.half_length - facing > 1e-9) {
    out.beyond = graded(geometry.half_length - facing);
    std::reverse(out.beyond.begin(), out.beyond.end());
  }
  if (geometry.neck_length > 0) {
    out.neck = graded_layers(geometry.neck_length, std::max(size.end_layer, 0.05 * geometry.neck_radius),
                             1.3 * size.layer_growth, size.largest_layer * 1.5);
    std::reverse(out.neck.begin(), out.neck.end());  // thin layers at the shoulder
  }
  return out;
}

void require_sound(const Meshed &meshed, const std::string &name)
{
  if (!meshed.empty_group.empty())
    throw SolverError(
        {"mesh of the " + name + ": no face belongs to the group " + meshed.empty_group, "", "", "", ""});
  if (!meshed.one_kind || meshed.smallest_jacobian <= 0)
    throw SolverError(
        {"mesh of the " + name + " failed its quality check",
         meshed.one_kind ? "an element is inverted" : "it has other elements than hexahedra",
         "a diameter, neck and contact half width that do not fit into one section",
         "check the diameters and lengths of the " + name +
             " (a neck of almost the barrel's diameter leaves no room) and contact.*.elements_per_half_width",
         ""});
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
  RollDrawing drawing;
  drawing.geometry        = by_radius(in_metres);
  const RollMeshSize size = by_radius(size_in_metres, in_metres.radius);
  drawing.section         = size.section;
  drawing.plain_elements  = size.plain_elements;
  drawing.patch =
      size.plain_elements > 0 ? plain_contact_half_width(drawing.geometry.radius) : patch_half_width(size.section);
  drawing.layers = layers_of(drawing.geometry, size);
  MeshFile mesh  = known_mesh(path, in_metres);
  drawing.groups = mesh.groups;
  Meshed meshed;
  write_mesh(path, [&](const std::string &aside) {
    meshed = mesher().mesh_roll(drawing, aside);
    require_sound(meshed, name);
    return meshed.not_written;
  });
  mesh.smallest_jacobian  = meshed.smallest_jacobian;
  mesh.n_nodes            = meshed.n_nodes;
  mesh.n_cells            = meshed.n_cells;
  mesh.contact_element    = size_in_metres.section.first_element;
  mesh.contact_half_width = drawing.patch * in_metres.radius;
  return mesh;
}
}  // namespace mill::meshes
