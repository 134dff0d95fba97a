#include "meshes/bearing/roller.h"
#include "core/base/errors.h"
#include "meshes/bearing/raceway.h"
#include "meshes/common/block.h"
#include "meshes/roll/roll.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tuple>

namespace mill::meshes {
namespace {
// The patch reaches this many half widths of the largest load: a tilted roller carries more at one end, and the
// law of slices spreads its loads over e^(1/2) = 1.65 of them (fem/bearing/roller_slices).
constexpr double patch_reach = 1.7;
// A piece of raceway is cut off where its depth no longer feels the load: at so many depths to each side.
constexpr double side_depths = 4;
// Ratio of neighbouring elements away from the contact; quadratic elements reproduce the field of a line load
// there.
constexpr double far_growth = 2.2;

double series(const double first, const double ratio, const int n)
{
  double sum = 0, element = first;
  for (int i = 0; i < n; ++i, element *= ratio)
    sum += element;
  return sum;
}

// Elements between 0 and `length` that start with `first` and grow by about `ratio`: a multiple of three of them,
// as the section needs, and the ratio that fits.
std::pair<int, double> fitted_series(const double first, const double ratio, const double length)
{
  const double wanted = std::log1p(length / first * (ratio - 1)) / std::log(ratio);
  const int n         = 3 * std::max(1, int(std::lround(wanted / 3)));
  double low = 1, high = 2 * length / first;
  for (int i = 0; i < 100; ++i) {
    const double middle                              = 0.5 * (low + high);
    (series(first, middle, n) < length ? low : high) = middle;
  }
  return {n, high};
}

RollMeshSize mesh_size(const RollerSetup &s)
{
  const double small = line_half_width(s, s.inner_radius, s.finest_load / s.contact_length),
               large = line_half_width(s, -s.outer_radius, s.largest_load / s.contact_length);
  RollMeshSize size;
  SectionSize &section = size.section;
  // Elements of half the wanted size at the line, growing so that one at distance b measures b / per.
  section.first_element = 0.5 * small / s.elements_per_half_width;
  std::tie(section.patch_elements, section.growth) =
      fitted_series(section.first_element, 1 + 0.5 / s.elements_per_half_width, patch_reach * large);
  // Below it the stress varies over the distance from the line as well.
  std::tie(section.depth_elements, section.depth_growth) =
      fitted_series(section.first_element, std::max(section.growth, 1.4), patch_reach * large);
  section.far_growth      = far_growth;
  section.sector_elements = 2;
  size.end_layer          = s.end_element;
  size.layer_growth       = far_growth;
  size.largest_layer      = s.largest_element;
  return size;
}

// Lines of the mesh: those of the patch, then growing elements to the length.
std::vector<double> extended(std::vector<double> lines, const double length)
{
  const double last = lines.back(), element = last - lines[lines.size() - 2];
  for (const double x : mesh_lines({0, 0, element, far_growth, length - last}))
    if (x > 0)
      lines.push_back(last + x);
  return lines;
}

// Mesh lines of the roller's patch: on its circle, elements in geometric series along the arc as Gmsh makes them.
std::vector<double> across(const SectionSize &section, const double radius)
{
  std::vector<double> x{0};
  const double whole = patch_half_width(section), angle = std::asin(whole / radius);
  double sum = 0, element = section.first_element;
  for (int i = 0; i < section.patch_elements; ++i, element *= section.growth) {
    sum += element;
    x.push_back(radius * std::sin(angle * sum / whole));
  }
  return x;
}

std::vector<double> along(const RollMeshSize &size, const double half_length)
{
  std::vector<double> z{0};
  for (const double layer : graded_layers(half_length, size.end_layer, size.layer_growth, size.largest_layer))
    z.push_back(z.back() + layer);
  return z;
}
}  // namespace

RollerMeshes mesh_roller(const RollerSetup &setup, const std::string &folder, const std::string &name)
{
  const RollerSetup s     = completed(setup);
  const RollMeshSize size = mesh_size(s);
  const auto file         = [&](const char *what) {
    return (std::filesystem::path(folder) / (name + "." + what + ".msh")).string();
  };
  RollGeometry geometry;
  geometry.radius      = 0.5 * s.diameter;
  geometry.half_length = 0.5 * s.length;
  if (s.contact_length < s.length * (1 - 1e-9))
    geometry.contact_half_length = 0.5 * s.contact_length;
  RollerMeshes out;
  out.roller         = mesh_roll(name, geometry, size, file("body"));
  const auto raceway = [&](const double radius, const double depth, const char *what) {
    RacewayPiece piece;
    piece.radius  = radius;
    piece.x       = across(size.section, geometry.radius);
    piece.z       = along(size, 0.5 * s.contact_length);
    piece.patch_x = piece.x.back();
    piece.patch_z = piece.z.back();
    piece.depth   = mesh_lines({0, 0, 1.5 * piece.x[1], far_growth, depth});
    piece.x       = extended(piece.x, side_depths * depth);
    piece.z       = extended(piece.z, piece.patch_z + s.land);
    return mesh_raceway(piece, file(what));
  };
  out.inner = raceway(s.inner_radius, s.inner_depth, "inner");
  out.outer = raceway(-s.outer_radius, s.outer_depth, "outer");
  return out;
}

void remove_meshes(const RollerMeshes &meshes)
{
  for (const MeshFile *mesh : {&meshes.roller, &meshes.inner, &meshes.outer}) {
    std::error_code ignored;
    std::filesystem::remove(mesh->path, ignored);
  }
}
}  // namespace mill::meshes
