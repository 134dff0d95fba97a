#include "tests/manual/peer/mesh.h"
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace mill::verify::peer {
namespace {
using Eigen::Vector3d;

// Local places of the twenty nodes, -1, 0 or 1 in each direction.
constexpr int local[20][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1},
                              {1, -1, 1},   {1, 1, 1},   {-1, 1, 1}, {0, -1, -1}, {1, 0, -1},
                              {0, 1, -1},   {-1, 0, -1}, {0, -1, 1}, {1, 0, 1},   {0, 1, 1},
                              {-1, 0, 1},   {-1, -1, 0}, {1, -1, 0}, {1, 1, 0},   {-1, 1, 0}};

// Faces S1 .. S6 of CalculiX: the direction that is fixed, and where.
constexpr int fixed_direction[6] = {2, 2, 1, 0, 1, 0}, fixed_at[6] = {-1, 1, -1, 1, 1, -1};

// Shape functions of the twenty-node hexahedron at x in [-1, 1]^3, and their derivatives (20 x 3).
void shape(const Vector3d &x, Eigen::Matrix<double, 20, 1> &N, Eigen::Matrix<double, 20, 3> &dN)
{
  for (int i = 0; i < 20; ++i) {
    const int *c      = local[i];
    const bool corner = c[0] != 0 && c[1] != 0 && c[2] != 0;
    double factor[3], slope[3];  // of each direction
    for (int a = 0; a < 3; ++a) {
      factor[a] = c[a] == 0 ? 1 - x[a] * x[a] : 1 + c[a] * x[a];
      slope[a]  = c[a] == 0 ? -2 * x[a] : c[a];
    }
    const double product = factor[0] * factor[1] * factor[2];
    const double sum     = c[0] * x[0] + c[1] * x[1] + c[2] * x[2] - 2;
    N[i]                 = corner ? product * sum / 8 : product / 4;
    for (int a = 0; a < 3; ++a) {
      const double by = slope[a] * factor[(a + 1) % 3] * factor[(a + 2) % 3];
      dN(i, a)        = corner ? (by * sum + product * c[a]) / 8 : by / 4;
    }
  }
}

Eigen::Matrix<double, 20, 3> places(const Mesh &mesh, const std::array<int, 20> &element)
{
  Eigen::Matrix<double, 20, 3> X;
  for (int i = 0; i < 20; ++i)
    X.row(i) = mesh.nodes[std::size_t(element[std::size_t(i)])];
  return X;
}

const double gauss[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weight[3] = {5. / 9, 8. / 9, 5. / 9};

int node_at(Mesh &mesh, const Vector3d &p)
{
  constexpr double grid = 1e-7;  // m: no two nodes are that close
  const std::array<long, 3> key{std::lround(p[0] / grid), std::lround(p[1] / grid), std::lround(p[2] / grid)};
  // A place next to a rounding boundary may have fallen on its other side.
  for (long i = -1; i <= 1; ++i)
    for (long j = -1; j <= 1; ++j)
      for (long k = -1; k <= 1; ++k)
        if (const auto match = mesh.positions.find({key[0] + i, key[1] + j, key[2] + k});
            match != mesh.positions.end())
          return match->second;
  mesh.positions[key] = int(mesh.nodes.size());
  mesh.nodes.push_back(p);
  return int(mesh.nodes.size()) - 1;
}
}  // namespace

std::vector<double> even(const int n)
{
  std::vector<double> lines(std::size_t(n) + 1);
  for (int i = 0; i <= n; ++i)
    lines[std::size_t(i)] = double(i) / n;
  return lines;
}

std::vector<double> towards_end(const double first, const int n, const double growth)
{
  std::vector<double> lines{1};
  double size = first;
  for (int i = 1; lines.back() - size > 0.5 * size; ++i) {
    lines.push_back(lines.back() - size);
    if (i >= n)
      size *= growth;
  }
  lines.push_back(0);
  std::reverse(lines.begin(), lines.end());
  return lines;
}

void add_block(Mesh &mesh, const std::vector<double> &u, const std::vector<double> &v,
               const std::vector<double> &w, const std::function<Vector3d(double, double, double)> &place)
{
  const auto between = [](const std::vector<double> &lines, const std::size_t i, const int index) {
    return index < 0 ? lines[i] : index > 0 ? lines[i + 1] : 0.5 * (lines[i] + lines[i + 1]);
  };
  for (std::size_t k = 0; k + 1 < w.size(); ++k)
    for (std::size_t j = 0; j + 1 < v.size(); ++j)
      for (std::size_t i = 0; i + 1 < u.size(); ++i) {
        std::array<int, 20> element{};
        for (int n = 0; n < 20; ++n)
          element[std::size_t(n)] = node_at(
              mesh, place(between(u, i, local[n][0]), between(v, j, local[n][1]), between(w, k, local[n][2])));
        Eigen::Matrix<double, 20, 1> N;
        Eigen::Matrix<double, 20, 3> dN;
        shape(Vector3d::Zero(), N, dN);
        if ((places(mesh, element).transpose() * dN).determinant() < 0) {  // bottom and top change places
          std::rotate(element.begin(), element.begin() + 4, element.begin() + 8);
          std::rotate(element.begin() + 8, element.begin() + 12, element.begin() + 16);
        }
        mesh.elements.push_back(element);
      }
}

void append(Mesh &mesh, const Mesh &body)
{
  const int first = int(mesh.nodes.size());
  mesh.nodes.insert(mesh.nodes.end(), body.nodes.begin(), body.nodes.end());
  for (std::array<int, 20> element : body.elements) {
    for (int &node : element)
      node += first;
    mesh.elements.push_back(element);
  }
}

std::vector<int> nodes_where(const Mesh &mesh, const std::function<bool(const Vector3d &)> &condition)
{
  std::vector<int> collected;
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    if (condition(mesh.nodes[i]))
      collected.push_back(int(i));
  return collected;
}

std::vector<Face> faces_where(const Mesh &mesh, const std::function<bool(const Vector3d &)> &condition)
{
  std::vector<char> good(mesh.nodes.size(), 0);
  for (const int node : nodes_where(mesh, condition))
    good[std::size_t(node)] = 1;
  std::vector<Face> collected;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (int f = 0; f < 6; ++f) {
      bool all = true;
      for (int i = 0; i < 20; ++i)
        if (local[i][fixed_direction[f]] == fixed_at[f])
          all = all && good[std::size_t(mesh.elements[e][std::size_t(i)])];
      if (all)
        collected.push_back({int(e), f + 1});
    }
  return collected;
}

Weights over_faces(const Mesh &mesh, const std::vector<Face> &faces)
{
  Weights weights;
  Eigen::Matrix<double, 20, 1> N;
  Eigen::Matrix<double, 20, 3> dN;
  for (const auto &[element, face] : faces) {
    const auto &nodes = mesh.elements[std::size_t(element)];
    const auto X      = places(mesh, nodes);
    const int f = fixed_direction[face - 1], a = (f + 1) % 3, b = (f + 2) % 3;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        Vector3d x;
        x[f] = fixed_at[face - 1];
        x[a] = gauss[i];
        x[b] = gauss[j];
        shape(x, N, dN);
        const Eigen::Matrix3d J = X.transpose() * dN;
        const double area       = J.col(a).cross(J.col(b)).norm() * weight[i] * weight[j];
        for (int n = 0; n < 20; ++n)
          if (N[n] != 0)
            weights[nodes[std::size_t(n)]] += area * N[n];
      }
  }
  return weights;
}

Weights over_body(const Mesh &mesh, const std::function<double(const Vector3d &)> &density)
{
  Weights weights;
  Eigen::Matrix<double, 20, 1> N;
  Eigen::Matrix<double, 20, 3> dN;
  for (const auto &nodes : mesh.elements) {
    const auto X = places(mesh, nodes);
    for (int i = 0; i < 27; ++i) {
      const int index[3] = {i % 3, i / 3 % 3, i / 9};
      shape(Vector3d(gauss[index[0]], gauss[index[1]], gauss[index[2]]), N, dN);
      const double here = density(X.transpose() * N);
      if (here == 0)
        continue;
      const double volume =
          (X.transpose() * dN).determinant() * weight[index[0]] * weight[index[1]] * weight[index[2]];
      for (int n = 0; n < 20; ++n)
        weights[nodes[std::size_t(n)]] += here * volume * N[n];
    }
  }
  return weights;
}

double total(const Weights &weights)
{
  return std::accumulate(weights.begin(), weights.end(), 0.,
                         [](const double sum, const auto &entry) { return sum + entry.second; });
}
}  // namespace mill::verify::peer
