#include "meshes/common/cells.h"
#include "core/base/errors.h"
#include "meshes/common/mesher.h"
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <map>

namespace mill::meshes {
namespace {
// Faces of a cell; orientation does not matter to a boundary group.
const std::vector<std::vector<int>> sides{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
const std::vector<std::vector<int>> hex_faces{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                              {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
// The neighbours of each corner, right-handed.
const int hex_neighbours[8][3] = {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                  {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};

Eigen::Vector3d at(const CellMesh &mesh, const int point)
{
  return Eigen::Map<const Eigen::Vector3d>(mesh.points[std::size_t(point)].data());
}

// Smallest corner Jacobian over the largest, of one cell.
double jacobian_ratio(const CellMesh &mesh, const std::vector<int> &cell)
{
  double low = 1e300, high = -1e300;
  const int n = int(cell.size());
  for (int c = 0; c < n; ++c) {
    Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
    const auto edge   = [&](const int other) -> Eigen::Vector3d {
      return at(mesh, cell[std::size_t(other)]) - at(mesh, cell[std::size_t(c)]);
    };
    if (n == 4) {
      J.col(0) = edge((c + 1) % 4);
      J.col(1) = edge((c + 3) % 4);
    } else
      for (int k = 0; k < 3; ++k)
        J.col(k) = edge(hex_neighbours[c][k]);
    low  = std::min(low, J.determinant());
    high = std::max(high, J.determinant());
  }
  return high > 0 ? low / high : -1;
}
}  // namespace

MeshFile write_cells(const CellMesh &mesh, const std::string &path)
{
  const bool solid = mesh.cells.at(0).size() == 8;
  MeshFile file;
  file.path              = path;
  file.n_cells           = int(mesh.cells.size());
  file.smallest_jacobian = 1;
  std::vector<int> tag(mesh.points.size(), 0);
  PlainMesh plain;
  plain.dimension = solid ? 3 : 2;
  std::map<std::vector<int>, std::pair<int, std::vector<int>>> faces;  // by sorted corners: count, corners
  for (const auto &cell : mesh.cells) {
    file.smallest_jacobian = std::min(file.smallest_jacobian, jacobian_ratio(mesh, cell));
    for (const int point : cell) {
      int &t = tag[std::size_t(point)];
      if (t == 0) {
        t             = ++file.n_nodes;
        const auto &p = mesh.points[std::size_t(point)];
        plain.coordinates.insert(plain.coordinates.end(), p.begin(), p.end());
      }
      plain.cells.push_back(std::size_t(t));
    }
    for (const auto &face : solid ? hex_faces : sides) {
      std::vector<int> corners, key;
      for (const int c : face)
        corners.push_back(cell[std::size_t(c)]);
      key = corners;
      std::sort(key.begin(), key.end());
      auto &entry = faces[key];
      ++entry.first;
      entry.second = corners;
    }
  }
  if (!(file.smallest_jacobian > 0))
    throw SolverError({"mesh of " + path + ": an element is inverted", "", "dimensions that contradict each other",
                       "check diameters, angles and the chock", ""});
  for (const auto &[key, face] : faces)
    if (face.first == 1)
      if (const std::string name = mesh.group(face.second); !name.empty())
        for (const int point : face.second)
          plain.group_faces[name].push_back(std::size_t(tag[std::size_t(point)]));
  file.groups = write_plain(std::move(plain), path);
  return file;
}
}  // namespace mill::meshes
