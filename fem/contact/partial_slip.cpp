#include "fem/contact/partial_slip.h"
#include "core/base/errors.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace mill::contact {
namespace {
constexpr double none = std::numeric_limits<double>::quiet_NaN();

// Least-squares line  square = top - slope x^2  through squares of tractions.
struct ContactEllipse {
  double top, slope;
  double edge() const  // where it is zero
  {
    return top > 0 && slope > 0 ? std::sqrt(top / slope) : none;
  }
  double at(const double x) const
  {
    return std::sqrt(std::max(0., top - slope * x * x));
  }
};

ContactEllipse ellipse_through(const std::vector<double> &x, const std::vector<double> &values)
{
  if (x.size() < 3)
    return {none, none};
  const double unit = *std::max_element(x.begin(), x.end());
  Eigen::MatrixXd A(x.size(), 2);
  Eigen::VectorXd b(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    A.row(Eigen::Index(i)) << 1, -x[i] * x[i] / (unit * unit);
    b[Eigen::Index(i)] = values[i] * values[i];
  }
  const Eigen::Vector2d line = (A.transpose() * A).inverse() * (A.transpose() * b);
  return {line[0], line[1] / (unit * unit)};
}

// Influence of one rectangle on another, whole steps apart in x and z.
class InfluenceTable {
public:
  InfluenceTable(const HalfSpaces &bodies, const double step_x, const double step_z, const int wide_x,
                 const int wide_z)
      : h_x(step_x), h_z(step_z), wide(wide_x), table(std::size_t(wide_x) * wide_z)
  {
    for (int k = 0; k < wide_z; ++k)
      for (int i = 0; i < wide_x; ++i)
        table[std::size_t(k) * wide + i] =
            rectangle_influence(bodies, {h_x / 2, h_z / 2}, i * h_x, k * h_z) / (h_x * h_z);
  }
  // Displacement by a unit force, rows and columns x, z, normal.
  Eigen::Matrix3d at(const double x, const double z) const
  {
    const int i = int(std::lround(std::abs(x) / h_x)), k = int(std::lround(std::abs(z) / h_z));
    Eigen::Matrix3d u = table[std::size_t(k) * wide + i];
    const double sx = x < 0 ? -1 : 1, sz = z < 0 ? -1 : 1;
    u(0, 1) *= sx * sz;
    u(1, 0) *= sx * sz;
    u(0, 2) *= sx;
    u(2, 0) *= sx;
    u(1, 2) *= sz;
    u(2, 1) *= sz;
    return u;
  }

private:
  double h_x, h_z;
  int wide;
  std::vector<Eigen::Matrix3d> table;
};
}  // namespace

StripContact strip_contact(const HalfSpaces &bodies, const std::function<double(double)> &gap, const double reach,
                           const int n, const double datum, const double mu)
{
  const double half = reach / n;
  StripContact out{{Eigen::MatrixXd::Zero(2 * n, 2 * n),
                    Eigen::MatrixXd::Zero(2 * n, 2),
                    {},
                    Eigen::VectorXd(n),
                    Eigen::VectorXd::Constant(n, mu)},
                   Eigen::VectorXd(n),
                   2 * half};
  FrictionProblem &p = out.problem;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Eigen::Matrix2d k = strip_influence(bodies, half, 2 * half * (i - j), datum);
      p.C(i, j)               = k(1, 1) / out.width;
      p.C(n + i, n + j)       = k(0, 0) / out.width;
      p.C(i, n + j)           = k(1, 0) / out.width;
      p.C(n + i, j)           = k(0, 1) / out.width;
    }
    out.x[i]         = (2 * i - n + 1) * half;
    p.initial_gap[i] = gap(out.x[i]);
  }
  p.G.col(0).head(n).setOnes();
  p.G.col(1).tail(n).setOnes();
  return out;
}

RectangleContact rectangle_contact(const HalfSpaces &bodies, const std::function<double(double, double)> &gap,
                                   const RectangleGrid &grid, const double mu)
{
  const double h_x = (grid.mirror_x ? 1 : 2) * grid.half_x / grid.n_x,
               h_z = (grid.mirror_z ? 1 : 2) * grid.half_z / grid.n_z;
  std::vector<Eigen::Vector2d> place;
  std::vector<double> gaps;
  for (int k = 0; k < grid.n_z; ++k)
    for (int i = 0; i < grid.n_x; ++i) {
      const Eigen::Vector2d position((i + 0.5) * h_x - (grid.mirror_x ? 0 : grid.half_x),
                                     (k + 0.5) * h_z - (grid.mirror_z ? 0 : grid.half_z));
      if (const double g = gap(position[0], position[1]); std::isfinite(g)) {
        place.push_back(position);
        gaps.push_back(g);
      }
    }
  require_input(!place.empty(), "half space: no rectangle of the grid has a finite gap");
  const int n = int(place.size());
  const InfluenceTable influence(bodies, h_x, h_z, 2 * grid.n_x, 2 * grid.n_z);
  RectangleContact out{{Eigen::MatrixXd::Zero(3 * n, 3 * n),
                        Eigen::MatrixXd::Zero(3 * n, 2),
                        {},
                        Eigen::Map<const Eigen::VectorXd>(gaps.data(), n),
                        Eigen::VectorXd::Constant(n, mu)},
                       Eigen::MatrixXd(n, 2),
                       h_x * h_z,
                       h_x,
                       (grid.mirror_x ? 0.5 : 1) * (grid.mirror_z ? 0.5 : 1),
                       grid.along};
  FrictionProblem &p                 = out.problem;
  const std::vector<double> images_x = grid.mirror_x ? std::vector<double>{1, -1} : std::vector<double>{1},
                            images_z = grid.mirror_z ? std::vector<double>{1, -1} : std::vector<double>{1};
  for (int a = 0; a < n; ++a) {
    out.place.row(a) = place[a].transpose();
    for (int b = 0; b < n; ++b)
      for (const double sx : images_x)
        for (const double sz : images_z) {
          const Eigen::Matrix3d u = influence.at(place[a][0] - sx * place[b][0], place[a][1] - sz * place[b][1]);
          // Of an image pressure and driven traction are the same, the traction across is turned by each mirror.
          const double turn_x = grid.along ? sx * sz : 1, turn_z = grid.along ? 1 : sx * sz;
          const double sign[3] = {turn_x, turn_z, 1};
          const int row[3] = {n + a, 2 * n + a, a}, column[3] = {n + b, 2 * n + b, b};
          for (int c = 0; c < 3; ++c)
            for (int r = 0; r < 3; ++r)
              p.C(row[r], column[c]) += u(r, c) * sign[c];
        }
  }
  p.G.col(0).head(n).setOnes();
  p.G.col(1).segment(grid.along ? 2 * n : n, n).setOnes();
  return out;
}

Eigen::VectorXd along_motion(const RectangleContact &contact, const FrictionState &state)
{
  const Eigen::Index n = contact.place.rows();
  return state.nodal.segment(contact.along ? 2 * n : n, n);
}

StickEdge stick_edge(const FrictionState &s, const Eigen::VectorXd &distance, const Eigen::VectorXd &along,
                     const double mu, const double area)
{
  const int n = int(s.status.size());
  std::vector<double> stuck, difference, sliding, traction;
  double last_stuck = 0, last_sliding = 0;
  for (int i = 0; i < n; ++i) {
    if (s.status[i] == Status::stick)
      last_stuck = std::max(last_stuck, distance[i]);
    if (s.status[i] == Status::slip)
      last_sliding = std::max(last_sliding, distance[i]);
  }
  // The outermost element of either kind covers the edge only partly: not used.
  for (int i = 0; i < n; ++i) {
    if (distance[i] < 0)
      continue;
    if (s.status[i] == Status::stick && distance[i] < 0.97 * last_stuck) {
      stuck.push_back(distance[i]);
      difference.push_back((mu * s.nodal[i] - along[i]) / area);
    }
    if (s.status[i] == Status::slip && distance[i] < 0.98 * last_sliding) {
      sliding.push_back(distance[i]);
      traction.push_back(along[i] / area);
    }
  }
  const double c = ellipse_through(stuck, difference).edge();
  return {last_stuck == 0 ? 0 : c, ellipse_through(sliding, traction).at(c)};
}
}  // namespace mill::contact
