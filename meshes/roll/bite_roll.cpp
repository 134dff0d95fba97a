#include "meshes/roll/bite_roll.h"
#include "core/base/errors.h"
#include "meshes/common/block.h"
#include "meshes/common/cells.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::meshes {
namespace {
using Point = std::array<double, 2>;

constexpr double core_share  = 0.45;  // of the radius: circle inside which the rays end in a block
constexpr double block_share = 0.55;  // of the core circle: corner distance of the block
constexpr int core_layers    = 3;     // between the circle and the block

// Points x >= 0.
std::vector<double> half_points(const BiteRollSize &size)
{
  const auto positive = [](const double x) { return x > 0 && std::isfinite(x); };
  if (!positive(size.radius) || !positive(size.arc) || !positive(size.spacing) || size.elements_per_spacing < 1 ||
      !(size.fine >= size.spacing) || !(size.reach > size.fine) || !(size.growth >= 1) || !(size.far_growth > 1))
    throw InputError(
        "roll in the bite: radius, arc, spacing < fine < reach must be positive and growth at least 1");
  const double limit = std::sin(40 * M_PI / 180);
  if (!(size.reach * size.arc < limit * size.radius))
    throw InputError(
        fmt::format("roll in the bite: points up to {:.4g} mm on a roll of radius {:.4g} mm; an arc that reaches "
                    "past {:.3g} mm (40 degrees) is not one of rolling strip: reduce the reach or the draft",
                    1e3 * size.reach * size.arc, 1e3 * size.radius, 1e3 * limit * size.radius));
  const int n = int(std::lround(size.fine / size.spacing));
  return mesh_lines({size.fine * size.arc, n, 0, size.growth, size.reach * size.arc});
}

// Angles from the contact line, 0 to 90 degrees: the points, subdivided, then growing.
std::vector<double> angles(const BiteRollSize &size)
{
  std::vector<double> out{0};
  const std::vector<double> x = half_points(size);
  for (std::size_t i = 1; i < x.size(); ++i) {
    const double a = std::asin(x[i - 1] / size.radius), b = std::asin(x[i] / size.radius);
    for (int k = 1; k <= size.elements_per_spacing; ++k)
      out.push_back(a + (b - a) * k / size.elements_per_spacing);
  }
  const double start = out.back(), last = start - out[out.size() - 2];
  auto rest = mesh_lines({0, 0, last * size.far_growth, size.far_growth, 0.5 * M_PI - start});
  for (std::size_t i = 1; i < rest.size(); ++i)
    out.push_back(start + rest[i]);
  return out;
}

Point on_circle(const double radius, const double angle)
{
  return {radius * std::sin(angle), radius * std::cos(angle)};
}
Point on_line(const Point &a, const Point &b, const double t)
{
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
}

// Block in the core, corners centre, a (on y), b, c (on x).  Along a-b and centre-c the shares s, along c-b and
// centre-a the shares t, both from 0 to 1.
struct CoreBlock {
  Point a, b, c;
  Point at(const double s, const double t) const
  {
    const Point low = on_line({0, 0}, c, s), high = on_line(a, b, s);
    return on_line(low, high, t);
  }
};
}  // namespace

std::vector<double> arc_points(const BiteRollSize &size)
{
  const std::vector<double> half = half_points(size);
  std::vector<double> out;
  for (auto x = half.rbegin(); x != half.rend(); ++x)
    out.push_back(-*x);
  out.insert(out.end(), half.begin() + 1, half.end());
  out[half.size() - 1] = 0;  // not -0
  return out;
}

MeshFile mesh_bite_roll(const BiteRollSize &size, const std::string &path)
{
  const std::vector<double> angle = angles(size);
  const double R = size.radius, core = core_share * R;
  const double first              = size.arc * size.spacing / size.elements_per_spacing;
  const std::vector<double> depth = mesh_lines({0, 0, first, size.far_growth, R - core});
  const int columns = int(angle.size()) - 1, layers = int(depth.size()) - 1;
  // The column whose ray ends in the corner b of the block: nearest to 45 degrees.
  int split = 1;
  for (int i = 1; i < columns; ++i)
    if (std::abs(angle[std::size_t(i)] - 0.25 * M_PI) < std::abs(angle[std::size_t(split)] - 0.25 * M_PI))
      split = i;
  const double corner = angle[std::size_t(split)];
  const CoreBlock block{on_circle(0.8 * block_share * core, 0), on_circle(block_share * core, corner),
                        on_circle(0.8 * block_share * core, 0.5 * M_PI)};
  // Shares of the block's sides that keep its lines in the direction of the rays.
  const auto share_s = [&](const int i) { return angle[std::size_t(i)] / corner; };
  const auto share_t = [&](const int i) { return (0.5 * M_PI - angle[std::size_t(i)]) / (0.5 * M_PI - corner); };
  const auto edge    = [&](const int i) { return i <= split ? block.at(share_s(i), 1) : block.at(1, share_t(i)); };

  CellMesh mesh;
  const auto add = [&](const Point &p) {
    mesh.points.push_back({p[0], p[1], 0});
    return int(mesh.points.size()) - 1;
  };
  // Rows of points along the angle: surface first, core circle at `layers`, block edge last.
  std::vector<std::vector<int>> row(std::size_t(layers + core_layers + 1), std::vector<int>(angle.size()));
  for (int j = 0; j <= layers + core_layers; ++j)
    for (int i = 0; i <= columns; ++i) {
      const Point on_core = on_circle(core, angle[std::size_t(i)]);
      row[std::size_t(j)][std::size_t(i)] =
          add(j <= layers ? on_circle(R - depth[std::size_t(j)], angle[std::size_t(i)])
                          : on_line(on_core, edge(i), double(j - layers) / core_layers));
    }
  for (std::size_t j = 0; j + 1 < row.size(); ++j)
    for (std::size_t i = 0; i + 1 < angle.size(); ++i)
      mesh.cells.push_back({row[j][i], row[j + 1][i], row[j + 1][i + 1], row[j][i + 1]});
  // Inside of the block: columns along s = 0 .. split, rows along t from the block's edge down to the x axis.
  const int rows_t = columns - split;
  std::vector<std::vector<int>> inside(std::size_t(rows_t + 1), std::vector<int>(std::size_t(split + 1)));
  for (int j = 0; j <= rows_t; ++j)
    for (int i = 0; i <= split; ++i) {
      auto &place = inside[std::size_t(j)][std::size_t(i)];
      if (j == 0)
        place = row.back()[std::size_t(i)];
      else if (i == split)
        place = row.back()[std::size_t(split + j)];
      else
        place = add(block.at(share_s(i), share_t(split + j)));
    }
  for (std::size_t j = 0; j + 1 < inside.size(); ++j)
    for (std::size_t i = 0; i + 1 < inside[j].size(); ++i)
      mesh.cells.push_back({inside[j][i], inside[j + 1][i], inside[j + 1][i + 1], inside[j][i + 1]});

  const double tiny = 1e-9 * R;
  mesh.group        = [points = mesh.points, R, tiny](const std::vector<int> &corners) -> std::string {
    const auto all = [&](const auto &condition) {
      return std::all_of(corners.begin(), corners.end(),
                                [&](const int c) { return condition(points[std::size_t(c)]); });
    };
    if (all([&](const auto &p) { return std::hypot(p[0], p[1]) > R - tiny; }))
      return "surface";
    if (all([&](const auto &p) { return p[0] < tiny; }))
      return "symmetry.x";
    return all([&](const auto &p) { return p[1] < tiny; }) ? "symmetry.y" : "";
  };
  MeshFile file           = write_cells(mesh, path);
  file.geometry.radius    = R;
  file.contact_element    = first;
  file.contact_half_width = size.reach * size.arc;
  return file;
}
}  // namespace mill::meshes
