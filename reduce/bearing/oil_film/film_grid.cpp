#include "reduce/bearing/oil_film/film_grid.h"
#include "core/base/errors.h"
#include "core/model/material.h"
#include <algorithm>
#include <cmath>

namespace mill::bearing {
namespace {
// Angles from the widest gap and the coordinate in which the grid is even: tan(t/2) = r tan(g/2).
struct EvenAngle {
  double widest;  // rad, angle of the widest gap
  double ratio;
  double angle(const double even) const
  {
    const double turns = std::floor((even + M_PI) / (2 * M_PI)), part = even - 2 * M_PI * turns;
    return widest + 2 * std::atan2(ratio * std::sin(part / 2), std::cos(part / 2)) + 2 * M_PI * turns;
  }
  double even(const double angle) const
  {
    const double t = std::remainder(angle - widest, 2 * M_PI);
    const double g = 2 * std::atan2(std::sin(t / 2) / ratio, std::cos(t / 2));
    return g < 0 ? g + 2 * M_PI : g;
  }
};

EvenAngle even_angle(const FilmProblem &p)
{
  const double reach = std::min(p.displacement.norm(), 0.98);
  return {std::atan2(p.displacement[1], p.displacement[0]) + M_PI, std::pow((1 + reach) / (1 - reach), 0.25)};
}

// Nodes around: even between the edges of the grooves, as many on a finer grid as its fineness says.
std::vector<double> angles_around(const FilmProblem &p, const FilmMesh &mesh)
{
  const EvenAngle map = even_angle(p);
  std::vector<double> edges;
  for (const FilmGroove &groove : p.grooves)
    for (const double side : {-0.5, 0.5})
      edges.push_back(map.even(groove.angle + side * groove.width));
  std::sort(edges.begin(), edges.end());
  if (edges.empty())
    edges.push_back(0);
  std::vector<double> out;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const double from = edges[k], to = k + 1 < edges.size() ? edges[k + 1] : edges[0] + 2 * M_PI;
    const int n = mesh.fineness * std::max(2, int(std::lround((to - from) / (2 * M_PI) * mesh.around)));
    for (int i = 0; i < n; ++i)
      out.push_back(map.angle(from + (to - from) * i / n));
  }
  return out;
}

// Finer towards the end, where pressure falls to zero.
double place_along(const double s)
{
  constexpr double even = 0.4;
  return even * s + (1 - even) * std::sin(M_PI / 2 * s);
}

void set_rows(FilmGrid &grid, const int along, const bool half)
{
  const int n = half ? along : 2 * along - 1;
  Eigen::VectorXd z(n + 2);  // with both ends
  if (half) {
    z[0] = 0;  // a plane of symmetry: the node below stands on it and its gap is zero
    for (int j = 0; j <= along; ++j)
      z[j + 1] = place_along(double(j) / along);
  } else
    for (int j = -along; j <= along; ++j)
      z[j + along] = std::copysign(place_along(std::abs(double(j)) / along), j);
  grid.z       = z.segment(1, n);
  grid.z_gap   = z.tail(n + 1) - z.head(n + 1);
  grid.z_width = 0.5 * (grid.z_gap.head(n) + grid.z_gap.tail(n));
  grid.mirror  = half ? 2 : 1;
}

void hold_nodes(FilmGrid &grid, const FilmProblem &p)
{
  grid.held = Eigen::MatrixXd::Constant(grid.rows(), grid.columns(), not_given);
  for (const FilmGroove &groove : p.grooves)
    for (Eigen::Index i = 0; i < grid.columns(); ++i)
      if (std::abs(std::remainder(grid.angle[i] - groove.angle, 2 * M_PI)) <=
          groove.width / 2 * (1 + 1e-9) + 1e-12)
        for (Eigen::Index j = 0; j < grid.rows(); ++j)
          if (std::abs(grid.z[j]) <= groove.length)
            grid.held(j, i) = groove.pressure;
  if (!p.from_widest_gap)
    return;
  const double widest = even_angle(p).widest;
  Eigen::Index place  = 0;
  for (Eigen::Index i = 0; i < grid.columns(); ++i)
    if (std::abs(std::remainder(grid.angle[i] - widest, 2 * M_PI)) <
        std::abs(std::remainder(grid.angle[place] - widest, 2 * M_PI)))
      place = i;
  grid.held.col(place).setZero();
}
}  // namespace

FilmGrid film_grid(const FilmProblem &p, const FilmMesh &mesh)
{
  require_input(mesh.around >= 8 && mesh.along >= 2 && mesh.fineness >= 1,
                "the grid of an oil film needs 8 intervals around and 2 along");
  FilmGrid grid;
  const auto around = angles_around(p, mesh);
  const auto n      = Eigen::Index(around.size());
  grid.angle        = Eigen::Map<const Eigen::VectorXd>(around.data(), n);
  grid.gap.resize(n);
  grid.gap.head(n - 1) = grid.angle.tail(n - 1) - grid.angle.head(n - 1);
  grid.gap[n - 1]      = grid.angle[0] + 2 * M_PI - grid.angle[n - 1];
  grid.width.resize(n);
  grid.width[0]          = 0.5 * (grid.gap[n - 1] + grid.gap[0]);
  grid.width.tail(n - 1) = 0.5 * (grid.gap.head(n - 1) + grid.gap.tail(n - 1));
  set_rows(grid, mesh.along * mesh.fineness, p.tilt.norm() == 0);
  hold_nodes(grid, p);
  return grid;
}

double rigid_film(const FilmProblem &p, const double angle, const double z)
{
  const Eigen::Vector2d position = p.displacement + z * p.tilt;
  return 1 - position[0] * std::cos(angle) - position[1] * std::sin(angle);
}

double least_rigid_film(const FilmProblem &p)
{
  return 1 - std::max((p.displacement + p.tilt).norm(), (p.displacement - p.tilt).norm());
}
}  // namespace mill::bearing
