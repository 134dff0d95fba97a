#include "meshes/bearing/bearing_rings.h"
#include "meshes/bearing/chock.h"
#include "meshes/bearing/ring_grid.h"
#include "meshes/common/cells.h"
#include <algorithm>
#include <cmath>
#include <filesystem>

namespace mill::meshes {
namespace {
RingGridSize section_size(const RingSection &s, const double refinement)
{
  RingGridSize size;
  const auto times    = [&](const int n) { return std::max(1, int(std::lround(n * refinement))); };
  size.on_raceway     = times(8);
  size.on_land        = times(1);
  size.in_wall        = times(4);
  size.in_reference   = times(5);
  size.beyond_growth  = std::pow(1.6, 1 / refinement);
  size.beyond_element = 0.25 * s.length / refinement;
  return size;
}

// Name of the raceway that a point of the mesh lies on, empty: none.
std::string raceway_at(const RingSection &s, const Eigen::Vector2d &p)
{
  for (std::size_t r = 0; r < s.raceways.size(); ++r) {
    const Eigen::Vector2d d = p - s.raceways[r].middle;
    if (std::abs(d.dot(s.raceways[r].normal)) < 1e-7 * s.length &&
        std::abs(d.dot(s.raceways[r].along)) < 0.5 * s.length)
      return "raceway." + std::to_string(r);
  }
  return "";
}

MeshFile write(const RingGrid &grid, const RingSection &s, const int held_layer, const std::string &path)
{
  CellMesh mesh;
  for (const Eigen::Vector2d &p : grid.points)
    mesh.points.push_back({p[0], p[1], 0});
  for (int j = 0; j + 1 < grid.n_layers; ++j)
    for (int i = 0; i + 1 < grid.n_columns; ++i)
      if (grid.kept[std::size_t(j * (grid.n_columns - 1) + i)])
        mesh.cells.push_back(
            {grid.point(i, j), grid.point(i, j + 1), grid.point(i + 1, j + 1), grid.point(i + 1, j)});
  mesh.group = [&](const std::vector<int> &corners) -> std::string {
    const auto on_layer = [&](const int layer) {
      return corners[0] / grid.n_columns == layer && corners[1] / grid.n_columns == layer;
    };
    const Eigen::Vector2d p = 0.5 * (grid.points[std::size_t(corners[0])] + grid.points[std::size_t(corners[1])]);
    if (held_layer >= 0 && on_layer(held_layer))
      return "held";
    if (s.inner && p[0] < 1e-9 * s.seat_radius)
      return "axis";
    return raceway_at(s, p);
  };
  return write_cells(mesh, path);
}

MeshFile write_raceway(const RingSection &whole, const RingGridSize &size, const std::string &path)
{
  RingSection s    = whole;
  const auto grid  = raceway_grid(s, size);
  RacewayLine line = s.raceways[0];
  line.normal[1]   = std::abs(line.normal[1]);
  line.along       = {-line.normal[1], line.normal[0]};
  line.middle[1]   = 0;
  s.raceways       = {line};
  return write(grid, s, s.inner ? 0 : grid.n_layers - 1, path);
}
}  // namespace

RingMeshSize coarsened(const RingMeshSize &size)
{
  // The block less: below two quadratic elements per wave of its last harmonic it would say more than it should.
  return {0.6 * size.sections, 0.8 * size.chock};
}

RingMeshes mesh_rings(const RingSections &sections, const RingMeshSize &size, const std::string &folder,
                      const std::string &name)
{
  const auto path = [&](const char *part) { return folder + "/" + name + "." + part + ".msh"; };
  const auto &[cone, cup, housing, material] = sections;
  const RingGridSize fine                    = section_size(cone, size.sections);
  RingMeshes out;
  out.cone         = write(cone_grid(cone, fine), cone, -1, path("cone"));
  const auto grid  = cup_grid(cup, housing, fine);
  out.cup          = write(grid, cup, grid.n_layers - 1, path("cup"));
  out.cone_raceway = write_raceway(cone, fine, path("cone-raceway"));
  out.cup_raceway  = write_raceway(cup, fine, path("cup-raceway"));
  if (housing.kind == ChockForm::block) {
    const auto lines  = cup_grid(cup, housing, chock_grid_size(cup, size.chock));
    out.chock         = mesh_chock(cup, housing, size.chock, path("chock"));
    out.chock_section = write(lines, cup, lines.n_layers - 1, path("chock-section"));
    out.chock_halved  = mirrored_rows(cup);
  }
  return out;
}

void remove_meshes(const RingMeshes &meshes)
{
  std::error_code ignored;
  for (const MeshFile *mesh : {&meshes.cone, &meshes.cup, &meshes.cone_raceway, &meshes.cup_raceway, &meshes.chock,
                               &meshes.chock_section})
    if (!mesh->path.empty())
      std::filesystem::remove(mesh->path, ignored);
}
}  // namespace mill::meshes
