#include "meshes/common/block.h"
#include "meshes/common/series.h"
#include "meshes/common/structured.h"
#include <cmath>

namespace mill::meshes {
std::vector<double> even_lines(const double a, const double b, const int n)
{
  std::vector<double> out(n + 1);
  for (int i = 0; i <= n; ++i)
    out[i] = a + (b - a) * i / n;
  return out;
}

std::vector<double> mesh_lines(const GradedLine &line)
{
  std::vector<double> out = line.n_fine > 0 ? even_lines(0, line.fine, line.n_fine) : std::vector<double>{0};
  const double rest = line.length - line.fine, first = line.first > 0 ? line.first : line.fine / line.n_fine;
  if (rest <= 0)
    return out;
  // As many elements as the wanted growth needs, then the growth that makes the last one end at `length`.
  const int n =
      std::max(1, int(std::lround(std::log1p(rest / first * (line.growth - 1)) / std::log(line.growth))));
  const double ratio = ratio_filling(rest, first, n), start = out.back(), scale = rest / sum_of(first, ratio, n);
  double h = first, position = 0;
  for (int i = 0; i + 1 < n; ++i, h *= ratio)
    out.push_back(start + scale * (position += h));
  out.push_back(line.length);
  return out;
}

MeshFile mesh_block(const BlockGrid &grid, const std::string &path)
{
  StructuredGrid out;
  out.n                  = {int(grid.x.size()), int(grid.y.size())};
  std::vector<double> zs = grid.z;
  if (zs.empty())
    zs = {0};
  else
    out.n.push_back(int(zs.size()));
  for (const double z : zs)
    for (const double y : grid.y)
      for (const double x : grid.x)
        out.points.push_back({x, y, z});
  out.group = [&grid](const int direction, const int side, const std::array<double, 3> &middle) -> std::string {
    if (direction == 1 && side == 1)
      return middle[0] > grid.patch_from_x && (grid.patch_x == 0 || middle[0] < grid.patch_x) &&
                     (grid.patch_z == 0 || middle[2] < grid.patch_z)
                 ? "patch"
                 : "top";
    const char *names[3][2] = {{"left", "right"}, {"bottom", "top"}, {"back", "front"}};
    return names[direction][side];
  };
  return write_grid(out, path);
}
}  // namespace mill::meshes
