#include "meshes/bearing/meridian.h"
#include "core/base/errors.h"
#include "meshes/common/mesher.h"
#include "meshes/common/write_mesh.h"
#include "meshes/roll/roll.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace mill::meshes {
namespace {
// Places along r: equal elements in the core, thinner and thinner ones towards the surface.
std::vector<double> radial_places(const RollGeometry &g, const MeridianSize &size)
{
  const double core    = g.neck_radius > 0 ? g.neck_radius : 0.5 * g.radius;
  const double largest = std::max(size.surface_element, g.radius * size.core_share);
  const int n_core     = std::max(2, int(std::ceil(core / largest)));
  std::vector<double> r;
  for (int i = 0; i <= n_core; ++i)
    r.push_back(core * i / n_core);
  for (const double h : graded_layers(g.radius - core, size.surface_element, size.radial_growth, largest))
    r.push_back(r.back() + h);
  r.back() = g.radius;
  return r;
}

// Layers thin where the contact ends, and at the shoulder.
RollLayers layers_of(const RollGeometry &g, const MeridianSize &size)
{
  const double facing = g.contact_half_length > 0 ? g.contact_half_length : g.half_length;
  const auto graded   = [&](const double length) {
    return graded_layers(length, size.end_layer, size.layer_growth, size.largest_share * facing);
  };
  RollLayers out;
  out.facing = graded(facing);
  if (g.half_length - facing > 1e-9) {
    out.beyond = graded(g.half_length - facing);
    std::reverse(out.beyond.begin(), out.beyond.end());
  }
  if (g.neck_length > 0) {
    out.neck = graded_layers(g.neck_length, std::max(size.end_layer, 0.02 * g.neck_radius), size.layer_growth,
                             1.5 * size.largest_share * facing);
    std::reverse(out.neck.begin(), out.neck.end());
  }
  return out;
}
}  // namespace

MeridianSize meridian_size(const double half_width)
{
  MeridianSize size;
  size.surface_element = 0.3 * half_width;
  size.end_layer       = 0.5 * half_width;
  return size;
}

MeridianSize even_meridian_size(const double half_width)
{
  MeridianSize size  = meridian_size(half_width);
  size.largest_share = 0.012;
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
  fine.core_share      = 0.5 * size.core_share;
  return fine;
}

MeshFile mesh_meridian(const std::string &name, const RollGeometry &g, const MeridianSize &size,
                       const std::string &path)
{
  MeridianDrawing drawing;
  drawing.geometry = g;
  drawing.radii    = radial_places(g, size);
  drawing.layers   = layers_of(g, size);
  Meshed meshed;
  write_mesh(path, [&](const std::string &aside) {
    meshed = mesher().mesh_meridian(drawing, aside);
    if (!meshed.one_kind)
      throw SolverError({"meridian mesh of the " + name + " has other elements than quadrilaterals", "",
                         "a neck that is as thick as the barrel", "check the diameters of the " + name, ""});
    return meshed.not_written;
  });
  MeshFile mesh;
  mesh.path            = path;
  mesh.geometry        = g;
  mesh.groups          = meshed.groups;
  mesh.n_nodes         = meshed.n_nodes;
  mesh.n_cells         = meshed.n_cells;
  mesh.contact_element = size.surface_element;
  return mesh;
}
}  // namespace mill::meshes
