#include "meshes/bearing/raceway.h"
#include "core/base/errors.h"
#include "meshes/common/structured.h"
#include <algorithm>
#include <cmath>

namespace mill::meshes {
namespace {
void require_lines(const std::vector<double> &lines, const char *what)
{
  const auto not_ascending = [](const double a, const double b) { return !(a < b); };
  if (lines.size() < 2 || lines.front() != 0 ||
      std::adjacent_find(lines.begin(), lines.end(), not_ascending) != lines.end())
    throw InputError(std::string("raceway: the mesh lines along ") + what + " must start at 0 and ascend");
}

// Point at distance x from the middle plane on the raceway, moved by `depth` along its normal.
std::array<double, 3> place(const double radius, const double x, const double depth, const double z)
{
  if (radius == 0)
    return {x, -depth, z};
  const double s = x / radius, c = std::sqrt(1 - s * s);  // concave: centre above, radius and angle both negative
  // (radius - depth) c - radius without the cancellation that would cost the thin layers their last digits
  return {(radius - depth) * s, -depth * c - radius * s * s / (1 + c), z};
}
}  // namespace

MeshFile mesh_raceway(const RacewayPiece &piece, const std::string &path)
{
  require_lines(piece.x, "x");
  require_lines(piece.depth, "the depth");
  const bool in_space = !piece.z.empty();
  if (in_space)
    require_lines(piece.z, "z");
  if (piece.radius != 0 && piece.x.back() >= std::abs(piece.radius))
    throw InputError("raceway: the piece is wider than the raceway");
  if (piece.radius > 0 && piece.depth.back() >= piece.radius)
    throw InputError("raceway: the piece is deeper than the raceway's radius");
  const std::vector<double> plane{0};
  StructuredGrid grid;
  grid.n = {int(piece.x.size()), int(piece.depth.size())};
  if (in_space)
    grid.n.push_back(int(piece.z.size()));
  // y ascends: the deepest layer comes first.
  for (const double z : in_space ? piece.z : plane)
    for (auto depth = piece.depth.rbegin(); depth != piece.depth.rend(); ++depth)
      for (const double x : piece.x)
        grid.points.push_back(place(piece.radius, x, *depth, z));
  const double reach_x = piece.patch_x > 0 ? piece.patch_x : piece.x.back(),
               reach_z = in_space && piece.patch_z > 0 ? piece.patch_z : 1e300;
  grid.group = [=](const int direction, const int side, const std::array<double, 3> &middle) -> std::string {
    if (direction == 0)
      return side == 0 ? "symmetry.x" : "side";
    if (direction == 2)
      return side == 0 ? "symmetry.z" : "end";
    if (side == 0)
      return "back";
    return middle[0] < reach_x && middle[2] < reach_z ? "patch" : "top";
  };
  return write_grid(grid, path);
}
}  // namespace mill::meshes
