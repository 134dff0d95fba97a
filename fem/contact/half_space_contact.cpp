#include "fem/contact/half_space_contact.h"
#include "core/base/errors.h"
#include "core/numerics/gauss.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace mill::contact {
namespace {
constexpr double none = std::numeric_limits<double>::quiet_NaN();

QuarterGrid checked(const QuarterGrid &grid)
{
  require_input(grid.width > 0 && grid.n_x > 0 && grid.z.size() > 1,
                "half space: the grid needs a width, columns and rows of rectangles");
  require_input((grid.half ? grid.z[0] < 0 : grid.z[0] == 0) &&
                    (grid.z.tail(grid.z.size() - 1) - grid.z.head(grid.z.size() - 1)).minCoeff() > 0,
                "half space: the edges of the rows must ascend from 0");
  return grid;
}

int n_z(const QuarterGrid &grid)
{
  return int(grid.z.size()) - 1;
}

double length(const QuarterGrid &grid, const int row)
{
  return grid.z[row + 1] - grid.z[row];
}

double middle(const QuarterGrid &grid, const int row)
{
  return (grid.z[row] + grid.z[row + 1]) / 2;
}

// Mean of the gap over one rectangle; exact for the parabola of a profile, and infinite if the rectangle's middle
// is not on the body.
double mean_gap(const QuarterGrid &grid, const GapShape &gap, const int column, const int row)
{
  static const GaussRule rule = gauss_legendre(3);
  const double x = grid.width * (column + 0.5), z = middle(grid, row);
  if (const double g = gap(x, z); !std::isfinite(g))
    return g;
  double mean = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const double g = gap(x + grid.width / 2 * rule.node[i], z + length(grid, row) / 2 * rule.node[j]);
      // A rectangle that the edge of the body cuts is judged by its middle.
      mean += rule.weight[i] * rule.weight[j] / 4 * (std::isfinite(g) ? g : gap(x, z));
    }
  return mean;
}

std::vector<int> rectangles_on_the_body(const QuarterGrid &grid, const GapShape &gap)
{
  std::vector<int> on;
  for (int j = 0; j < n_z(grid); ++j)
    for (int i = 0; i < grid.n_x; ++i)
      if (std::isfinite(gap(grid.width * (i + 0.5), middle(grid, j))))
        on.push_back(i + grid.n_x * j);
  require_input(!on.empty(), "half space: no rectangle of the grid has a finite gap");
  return on;
}

// Mean displacement of each rectangle by a unit force on another and, of a quarter, on its image at -z.  The
// columns are equally wide, so only the distance of two columns matters: entry k, (row, row).
std::vector<Eigen::MatrixXd> flexibility_by_distance(const HalfSpaces &bodies, const QuarterGrid &grid)
{
  std::vector<Eigen::MatrixXd> table(2 * grid.n_x, Eigen::MatrixXd(n_z(grid), n_z(grid)));
  for (int k = 0; k < 2 * grid.n_x; ++k)
    for (int i = 0; i < n_z(grid); ++i)
      for (int j = 0; j <= i; ++j) {
        const Rectangle a{grid.width / 2, length(grid, i) / 2}, b{grid.width / 2, length(grid, j) / 2};
        const double x = k * grid.width, zi = middle(grid, i), zj = middle(grid, j);
        table[k](i, j) = bodies.normal / (4 * a.half_x * a.half_y) *
                         (mean_potential(a, b, x, zi - zj) + (grid.half ? 0 : mean_potential(a, b, x, zi + zj)));
        table[k](j, i) = table[k](i, j);
      }
  return table;
}

// One driven motion, the approach; its resultant is the load of the grid.
Problem problem(const HalfSpaces &bodies, const QuarterGrid &grid, const GapShape &gap,
                const std::vector<int> &rectangle)
{
  const auto table = flexibility_by_distance(bodies, grid);
  const int n      = int(rectangle.size());
  Problem p;
  p.C.resize(n, n);
  p.G = Eigen::MatrixXd::Ones(n, 1);
  p.initial_gap.resize(n);
  for (int b = 0; b < n; ++b) {
    const int column = rectangle[b] % grid.n_x, row = rectangle[b] / grid.n_x;
    p.initial_gap[b] = mean_gap(grid, gap, column, row);
    for (int a = 0; a < n; ++a) {
      const int i = rectangle[a] % grid.n_x, j = rectangle[a] / grid.n_x;
      p.C(a, b) = table[std::abs(i - column)](j, row) + table[i + column + 1](j, row);  // and its image at -x
    }
  }
  return p;
}
}  // namespace

Eigen::VectorXd graded_edges(const double length, const double at_middle, const double at_end, const double growth)
{
  require_input(length > 0 && at_middle > 0 && at_end > 0 && growth >= 1,
                "graded edges: lengths must be positive and the growth at least 1");
  std::vector<double> from_end{0};
  for (double step = at_end; from_end.back() + 1.5 * step < length; step = std::min(at_middle, growth * step))
    from_end.push_back(from_end.back() + step);
  from_end.push_back(length);
  Eigen::VectorXd edges(from_end.size());
  for (std::size_t i = 0; i < from_end.size(); ++i)
    edges[i] = length - from_end[from_end.size() - 1 - i];
  return edges;
}

PressureFit fit_pressure(const std::vector<double> &x, const std::vector<double> &p)
{
  if (p.size() < 4)
    return {none, none};
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right  = Eigen::Vector2d::Zero();
  const double unit      = x[p.size() - 2];
  for (std::size_t i = 0; i + 1 < p.size(); ++i) {
    const Eigen::Vector2d row(1, x[i] * x[i] / (unit * unit));
    normal += row * row.transpose();
    right += row * p[i] * p[i];
  }
  const Eigen::Vector2d line = normal.ldlt().solve(right);  // p^2 = line[0] + line[1] (x / unit)^2
  if (!(line[0] > 0 && line[1] < 0))
    return {none, none};
  return {unit * std::sqrt(-line[0] / line[1]), std::sqrt(line[0])};
}

HalfSpaceContact::HalfSpaceContact(const HalfSpaces &bodies, const QuarterGrid &the_grid, const GapShape &gap)
    : grid(checked(the_grid)), goes_on(std::isfinite(gap(grid.width * (grid.n_x + 0.5), middle(grid, 0)))),
      rectangle(rectangles_on_the_body(grid, gap)), solver(problem(bodies, grid, gap, rectangle))
{
}

HalfSpaceState HalfSpaceContact::at_load(const double load)
{
  require_input(load > 0, "half space: the load must be positive");
  Loading loading;
  loading.value       = Eigen::VectorXd::Constant(1, load / grid.mirrors());
  const State quarter = solver.solve(loading);

  HalfSpaceState s;
  s.load        = load;
  s.approach    = quarter.motion[0];
  s.set_tangent = grid.mirrors() / quarter.compliance(0, 0);
  s.n_unknowns  = int(rectangle.size());
  s.iterations  = quarter.iterations;
  s.residual    = quarter.residual;
  s.pressure    = Eigen::MatrixXd::Zero(grid.n_x, n_z(grid));
  for (std::size_t a = 0; a < rectangle.size(); ++a) {
    const int i = rectangle[a] % grid.n_x, j = rectangle[a] / grid.n_x;
    s.pressure(i, j) = quarter.nodal[Eigen::Index(a)] / (grid.width * length(grid, j));
  }
  s.z.resize(n_z(grid));
  s.half_width.resize(n_z(grid));
  s.peak_pressure.resize(n_z(grid));
  s.line_load = 2 * grid.width * s.pressure.colwise().sum().transpose();
  for (int j = 0; j < n_z(grid); ++j) {
    std::vector<double> x, p;
    for (int i = 0; i < grid.n_x && s.pressure(i, j) > 0; ++i) {
      x.push_back(grid.width * (i + 0.5));
      p.push_back(s.pressure(i, j));
    }
    const PressureFit fit = fit_pressure(x, p);
    s.z[j]                = middle(grid, j);
    s.half_width[j]       = fit.half_width;
    s.peak_pressure[j]    = std::isnan(fit.peak) ? s.pressure.col(j).maxCoeff() : fit.peak;
  }
  if (goes_on && s.pressure.row(grid.n_x - 1).maxCoeff() > 0)
    throw SolverError({"half space: the contact is wider than the grid",
                       "the outermost column of rectangles carries load",
                       "a grid narrower than the contact at this load", "make the grid wider", ""});
  s.reaches_end = s.line_load[n_z(grid) - 1] > 0 || (grid.half && s.line_load[0] > 0);
  for (int j = 0; grid.half && j < n_z(grid); ++j)
    s.moment += s.line_load[j] * length(grid, j) * s.z[j];
  return s;
}

double smooth_tangent(const double load, const std::function<double(double)> &approach)
{
  // ln(approach) over ln(load) is a straight line for a point contact and nearly so for a line contact.
  Eigen::MatrixXd powers(9, 3);
  Eigen::VectorXd values(9);
  for (int i = 0; i < 9; ++i) {
    const double t = (i - 4) / 20.;  // ln(load) / load within 20 %
    values[i]      = std::log(approach(load * std::exp(t)));
    powers.row(i) << 1, t, t * t;
  }
  const Eigen::Vector3d fit = (powers.transpose() * powers).ldlt().solve(powers.transpose() * values);
  return load / std::exp(fit[0]) / fit[1];
}

double HalfSpaceContact::tangent(const double load)
{
  return smooth_tangent(load, [&](const double one_load) { return at_load(one_load).approach; });
}

bool has_singular_end(const HalfSpaces &bodies, const QuarterGrid &grid, const GapShape &gap, const double load)
{
  const HalfSpaceState coarse = HalfSpaceContact(bodies, grid, gap).at_load(load);
  if (!coarse.reaches_end)
    return false;
  const int n      = int(grid.z.size());
  const double end = grid.z[n - 1], row = end - grid.z[n - 2];
  QuarterGrid finer = grid;
  finer.z.resize(n + 2);
  finer.z << grid.z.head(n - 1), end - row / 2, end - row / 4, end;
  if (grid.half) {  // the other end as well
    const double begin = grid.z[0], first = grid.z[1] - begin;
    const Eigen::VectorXd others = finer.z.tail(n + 1);
    finer.z.resize(n + 4);
    finer.z << begin, begin + first / 4, begin + first / 2, others;
  }
  const HalfSpaceState fine = HalfSpaceContact(bodies, finer, gap).at_load(load);
  const double power        = std::log(fine.pressure.maxCoeff() / coarse.pressure.maxCoeff()) / std::log(4.);
  return power >= 0.2;
}
}  // namespace mill::contact
