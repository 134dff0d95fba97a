#include "meshes/common/structured.h"
#include "core/base/errors.h"
#include "meshes/common/mesher.h"
#include <Eigen/Geometry>
#include <limits>

namespace mill::meshes {
namespace {
// Walks the cells and faces of a grid.
class Walk {
public:
  explicit Walk(const StructuredGrid &g) : grid(g), dim(int(g.n.size()))
  {
    stride = {1, g.n[0], dim == 3 ? g.n[0] * g.n[1] : 0};
  }

  // Corners of a cell face spanned by the given directions, counter-clockwise in them.
  std::vector<std::size_t> corners(const int first, const std::vector<int> &along) const
  {
    std::vector<std::size_t> out{tag(first), tag(first + stride[along[0]])};
    if (along.size() > 1) {
      out.push_back(tag(first + stride[along[0]] + stride[along[1]]));
      out.push_back(tag(first + stride[along[1]]));
    }
    if (along.size() > 2)
      for (int k = 0; k < 4; ++k)
        out.push_back(out[k] + std::size_t(stride[along[2]]));
    return out;
  }

  // Calls with the first node of every cell of the box spanned by `along`; the other direction stays at `fixed`.
  template <class Call>
  void each(const std::vector<int> &along, const int other, const int fixed, const Call &call) const
  {
    std::array<int, 3> i{0, 0, 0};
    const auto first = [&] { return i[0] * stride[0] + i[1] * stride[1] + i[2] * stride[2]; };
    if (other >= 0)
      i[other] = fixed;
    const int a = along[0], b = along.size() > 1 ? along[1] : -1, c = along.size() > 2 ? along[2] : -1;
    for (int w = 0; w < (c < 0 ? 1 : grid.n[c] - 1); ++w)
      for (int v = 0; v < (b < 0 ? 1 : grid.n[b] - 1); ++v)
        for (int u = 0; u < grid.n[a] - 1; ++u) {
          i[a] = u;
          if (b >= 0)
            i[b] = v;
          if (c >= 0)
            i[c] = w;
          call(first());
        }
  }

  const StructuredGrid &grid;
  const int dim;
  std::array<int, 3> stride;

private:
  static std::size_t tag(const int node)
  {
    return std::size_t(node) + 1;
  }
};

// Smallest corner Jacobian over the largest, of one cell.
double jacobian_ratio(const Walk &walk, const int first)
{
  double low = std::numeric_limits<double>::max(), high = -low;
  for (int corner = 0; corner < (1 << walk.dim); ++corner) {
    Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
    int base          = first;
    for (int d = 0; d < walk.dim; ++d)
      base += (corner >> d & 1) * walk.stride[d];
    for (int d = 0; d < walk.dim; ++d) {
      const int from = base - (corner >> d & 1) * walk.stride[d], to = from + walk.stride[d];
      for (int c = 0; c < 3; ++c)
        J(c, d) = walk.grid.points[to][c] - walk.grid.points[from][c];
    }
    low  = std::min(low, J.determinant());
    high = std::max(high, J.determinant());
  }
  return high > 0 ? low / high : -1;
}
}  // namespace

MeshFile write_grid(const StructuredGrid &grid, const std::string &path)
{
  const Walk walk(grid);
  std::vector<int> all(walk.dim);
  for (int d = 0; d < walk.dim; ++d)
    all[d] = d;
  MeshFile mesh;
  mesh.path              = path;
  mesh.n_nodes           = int(grid.points.size());
  mesh.smallest_jacobian = 1;
  PlainMesh plain;
  plain.dimension = walk.dim;
  walk.each(all, -1, 0, [&](const int first) {
    ++mesh.n_cells;
    mesh.smallest_jacobian = std::min(mesh.smallest_jacobian, jacobian_ratio(walk, first));
    for (const std::size_t node : walk.corners(first, all))
      plain.cells.push_back(node);
  });
  if (!(mesh.smallest_jacobian > 0))
    throw SolverError({"structured mesh: an element is inverted", "", "mesh lines that do not ascend",
                       "check the coordinates of the mesh lines", ""});

  for (int d = 0; d < walk.dim; ++d) {
    std::vector<int> along;
    for (int other = 0; other < walk.dim; ++other)
      if (other != d)
        along.push_back(other);
    for (const int side : {0, 1})
      walk.each(along, d, side * (grid.n[d] - 1), [&](const int first) {
        const auto corners = walk.corners(first, along);
        std::array<double, 3> middle{0, 0, 0};
        for (const std::size_t node : corners)
          for (int c = 0; c < 3; ++c)
            middle[c] += grid.points[node - 1][c] / double(corners.size());
        auto &group = plain.group_faces[grid.group(d, side, middle)];
        group.insert(group.end(), corners.begin(), corners.end());
      });
  }

  plain.coordinates.reserve(3 * grid.points.size());
  for (const auto &point : grid.points)
    plain.coordinates.insert(plain.coordinates.end(), point.begin(), point.end());
  mesh.groups = write_plain(std::move(plain), path);
  return mesh;
}
}  // namespace mill::meshes
