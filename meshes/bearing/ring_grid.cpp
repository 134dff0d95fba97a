#include "meshes/bearing/ring_grid.h"
#include <algorithm>
#include <cmath>

namespace mill::meshes {
namespace {
using Points = std::vector<Eigen::Vector2d>;

// Places along a raceway from mid-roller, m: lines thin towards the ends of the contact, where the displacement
// under an even load turns steeply.
std::vector<double> along_raceway(const RingSection &s, const RingGridSize &size)
{
  std::vector<double> x;
  const int n = size.on_raceway, n_land = size.on_land;
  for (int i = n_land; i > 0; --i)
    x.push_back(-0.5 * s.length - s.land * i / n_land);
  for (int i = 0; i <= n; ++i) {
    const double u = -1 + 2. * i / n;
    x.push_back(0.5 * s.length * (0.5 * u + 0.5 * std::sin(0.5 * M_PI * u)));
  }
  for (int i = 1; i <= n_land; ++i)
    x.push_back(0.5 * s.length + s.land * i / n_land);
  return x;
}

// An even number of equal steps from the last point to `to`, without the first.
void join(Points &line, const Eigen::Vector2d &to, const double element)
{
  const Eigen::Vector2d from = line.back();
  const int n                = 2 * std::max(1, int(std::lround(0.5 * std::abs(to[1] - from[1]) / element)));
  for (int i = 1; i <= n; ++i)
    line.push_back(from + double(i) / n * (to - from));
}

double beyond(const RingSection &s, const RingGridSize &size)
{
  return size.beyond_element > 0 ? size.beyond_element : 0.25 * s.length;
}

// The rolling surface from end to end: (r, z) at every column.
Points surface_line(const RingSection &s, const RingGridSize &size, const double last)
{
  const auto x         = along_raceway(s, size);
  const double element = beyond(s, size);
  Points line;
  for (const RacewayLine &raceway : s.raceways) {
    const Eigen::Vector2d first = raceway.middle + x.front() * raceway.along;
    if (line.empty()) {
      line.push_back({first[0], -last});
      if (last > s.half_width * (1 + 1e-9))
        join(line, {first[0], -s.half_width}, 3 * element);
    }
    join(line, first, element);
    for (std::size_t i = 1; i < x.size(); ++i)
      line.push_back(raceway.middle + x[i] * raceway.along);
  }
  join(line, {line.back()[0], std::min(last, s.half_width)}, element);
  if (last > s.half_width * (1 + 1e-9))
    join(line, {line.back()[0], last}, 3 * element);
  return line;
}

// 0 .. 1 in n steps that grow by 1.5.
std::vector<double> growing_steps(const int n)
{
  std::vector<double> f{0};
  double step = 1;
  for (int i = 0; i < n; ++i, step *= 1.5)
    f.push_back(f.back() + step);
  const double total = f.back();
  for (double &v : f)
    v /= total;
  return f;
}

// Steps that grow from `first` to at most `largest`, filling `length`; ascending places from 0.
std::vector<double> growing_to(const double length, const double first, const double growth, const double largest)
{
  std::vector<double> places{0};
  for (double step = first; places.back() < length; step = std::min(largest, step * growth))
    places.push_back(places.back() + step);
  const double scale = length / places.back();
  for (double &p : places)
    p *= scale;
  places.back() = length;
  return places;
}

RingGrid empty_grid(const int n_columns, const int n_layers)
{
  RingGrid g;
  g.n_columns = n_columns;
  g.n_layers  = n_layers;
  g.points.resize(std::size_t(n_columns) * std::size_t(n_layers));
  g.kept.assign(std::size_t(n_columns - 1) * std::size_t(n_layers - 1), 1);
  return g;
}
}  // namespace

RingGrid cone_grid(const RingSection &s, const RingGridSize &size)
{
  const Points line = surface_line(s, size, s.half_width);
  const auto wall   = growing_steps(size.in_wall);
  const double thin = std::abs(s.raceways[0].middle[0] - s.seat_radius);
  auto neck         = growing_to(s.seat_radius, 0.4 * thin * 4 / size.in_wall, size.beyond_growth,
                                 0.25 * s.seat_radius * 4 / size.in_wall);
  RingGrid g        = empty_grid(int(line.size()), int(neck.size()) + size.in_wall);
  g.seat_layer      = int(neck.size()) - 1;
  for (int i = 0; i < g.n_columns; ++i) {
    const Eigen::Vector2d p = line[std::size_t(i)];
    for (int j = 0; j < g.n_layers; ++j) {
      const double r = j <= g.seat_layer ? s.seat_radius - neck[std::size_t(g.seat_layer - j)]
                                         : p[0] - wall[std::size_t(g.n_layers - 1 - j)] * (p[0] - s.seat_radius);
      g.points[std::size_t(g.point(i, j))] = {r, p[1]};
    }
  }
  return g;
}

RingGrid cup_grid(const RingSection &s, const Housing &housing, const RingGridSize &size)
{
  const bool rigid  = housing.kind == ChockForm::rigid;
  const double last = rigid ? s.half_width : std::max(s.half_width, housing.half_length);
  const Points line = surface_line(s, size, last);
  const auto wall   = growing_steps(size.in_wall);
  const double thin = std::abs(s.raceways[0].middle[0] - s.seat_radius);
  std::vector<double> outside{0};
  if (!rigid)
    outside = growing_to(housing.radius - s.seat_radius, 0.4 * thin * 4 / size.in_wall, size.beyond_growth,
                         0.3 * (housing.radius - s.seat_radius) * 4 / size.in_wall);
  RingGrid g   = empty_grid(int(line.size()), size.in_wall + int(outside.size()));
  g.seat_layer = size.in_wall;
  for (int i = 0; i < g.n_columns; ++i) {
    const Eigen::Vector2d p = line[std::size_t(i)];
    for (int j = 0; j < g.n_layers; ++j)
      g.points[std::size_t(g.point(i, j))] = {j < g.seat_layer
                                                  ? p[0] + wall[std::size_t(j)] * (s.seat_radius - p[0])
                                                  : s.seat_radius + outside[std::size_t(j - g.seat_layer)],
                                              p[1]};
  }
  // A housing shorter than the bearing ends on the column nearest to its end.
  for (int i = 0; i + 1 < g.n_columns; ++i) {
    const double z = std::abs(0.5 * (line[std::size_t(i)][1] + line[std::size_t(i) + 1][1]));
    for (int j = 0; j + 1 < g.n_layers; ++j)
      g.kept[std::size_t(j * (g.n_columns - 1) + i)] =
          z < (j < g.seat_layer || rigid ? s.half_width : housing.half_length);
  }
  return g;
}

RingGrid raceway_grid(const RingSection &s, const RingGridSize &size)
{
  RacewayLine line = s.raceways[0];
  if (line.hand < 0) {
    line.normal[1] = -line.normal[1];
    line.along[0]  = -line.along[0];
  }
  const auto x     = along_raceway(s, size);
  const auto depth = growing_steps(size.in_reference);
  RingGrid g       = empty_grid(int(x.size()), int(depth.size()));
  for (int i = 0; i < g.n_columns; ++i)
    for (int j = 0; j < g.n_layers; ++j) {
      const double y = s.inner ? -depth[std::size_t(g.n_layers - 1 - j)] : depth[std::size_t(j)];
      g.points[std::size_t(g.point(i, j))] =
          Eigen::Vector2d(line.middle[0], 0) + x[std::size_t(i)] * line.along + y * s.depth * line.normal;
    }
  return g;
}
}  // namespace mill::meshes
