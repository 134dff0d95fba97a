#include "fem/strip/rigid_plastic/strip_flow_grid.h"
#include <algorithm>
#include <cmath>

namespace mill::fem {
namespace {
using Eigen::VectorXd;

VectorXd every_second(const VectorXd &lines)
{
  VectorXd out((lines.size() + 1) / 2);
  for (Eigen::Index i = 0; i < out.size(); ++i)
    out[i] = lines[2 * i];
  return out;
}

// Interval of rising lines that holds t, and the place -1 .. 1 in it.
struct Place1 {
  int interval;
  double t;
};
Place1 place_in(const VectorXd &lines, const double t)
{
  const auto *begin = lines.data(), *end = begin + lines.size();
  const int i = std::clamp(int(std::upper_bound(begin, end, t) - begin) - 1, 0, int(lines.size()) - 2);
  return {i, std::clamp(2 * (t - lines[i]) / (lines[i + 1] - lines[i]) - 1, -1., 1.)};
}

// Place of a corner or middle spine along the strip: 0 to 1 before the contact, 1 to 2 on it, 2 to 3 behind it.
VectorXd along_strip(const StripLines &lines)
{
  VectorXd s(lines.inlet.size() + lines.arc.size() + lines.outlet.size() - 2);
  s << (1 - lines.inlet.array() / lines.inlet[0]).matrix(),
      (1 + lines.arc.tail(lines.arc.size() - 1).array()).matrix(),
      (2 + lines.outlet.tail(lines.outlet.size() - 1).array() / lines.outlet[lines.outlet.size() - 1]).matrix();
  return s;
}

double at_node(const VectorXd &lines, const int i)
{
  return i % 2 == 0 ? lines[i / 2] : 0.5 * (lines[i / 2] + lines[i / 2 + 1]);
}
}  // namespace

bool coarsened(StripLines &lines)
{
  for (const VectorXd *v : {&lines.inlet, &lines.arc, &lines.outlet, &lines.rows})
    if (v->size() % 2 == 0)
      return false;
  if (lines.arc.size() < 25 || lines.rows.size() < 7)
    return false;
  for (VectorXd *v : {&lines.inlet, &lines.arc, &lines.outlet, &lines.rows})
    *v = every_second(*v);
  return true;
}

StripGrid strip_grid(const StripLines &lines)
{
  StripGrid g;
  g.lines          = lines;
  const int before = int(lines.inlet.size()) - 1, on = int(lines.arc.size()) - 1,
            behind = int(lines.outlet.size()) - 1;
  g.n_along        = before + on + behind;
  g.n_through      = int(lines.rows.size()) - 1;
  g.first          = 2 * before;
  g.last           = 2 * (before + on);
  for (int i = 0; i < before; ++i)
    g.spine.push_back({1, 0, -lines.inlet[i]});
  for (int i = 0; i < on; ++i)
    g.spine.push_back({1 - lines.arc[i], lines.arc[i], 0});
  for (int i = 0; i <= behind; ++i)
    g.spine.push_back({0, 1, lines.outlet[i]});

  const int columns = 2 * g.n_along + 1, rows = 2 * g.n_through + 1;
  // Along the strip, so that a good order of elimination is easy to find.
  int n           = 0;
  const auto take = [&n](std::vector<int> &of, const int count) {
    for (int k = 0; k < count; ++k)
      of.push_back(n++);
  };
  for (int i = 0; i < columns; ++i) {
    take(g.velocity_of, 2 * rows);
    take(g.height_of, g.n_through);
    if (i % 2 == 0) {
      take(g.pressure_of, g.n_through + 1);
      take(g.strain_of, 3 * g.n_through);
    }
    g.contact_of.push_back(i >= g.first && i <= g.last ? n++ : -1);
  }
  g.n_unknowns = n + n_whole;
  g.held.assign(g.n_unknowns, 0);
  for (int i = 0; i < columns; ++i)
    g.held[g.velocity(i, 0, 1)] = 1;
  for (int j = 0; j < rows; ++j)
    g.held[g.velocity(0, j, 1)] = g.held[g.velocity(columns - 1, j, 1)] = 1;
  return g;
}

Eigen::VectorXd interpolated(const StripGrid &from, const VectorXd &unknowns, const StripGrid &to)
{
  VectorXd out       = VectorXd::Zero(to.n_unknowns);
  const VectorXd old = along_strip(from.lines), lines = along_strip(to.lines);
  const StripShapes &shapes = strip_shapes();
  const auto value          = [&](const int index) { return index < 0 ? 0. : unknowns[index]; };
  // Strain between the Gauss rows of an element, on one corner spine.
  const auto strain = [&](const int I, const Place1 &row) {
    double sum = 0;
    for (int k = 0; k < 3; ++k)
      sum += lagrange(shapes.point, k, row.t) * value(from.strain(I, row.interval, k));
    return sum;
  };
  for (int i = 0; i <= 2 * to.n_along; ++i) {
    const Place1 along = place_in(old, at_node(lines, i));
    const int I        = along.interval;
    const double right = 0.5 * (1 + along.t);
    for (int j = 0; j <= 2 * to.n_through; ++j) {
      const Place1 row = place_in(from.lines.rows, at_node(to.lines.rows, j));
      const int J      = row.interval;
      for (int c = 0; c < 2; ++c)
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b)
            out[to.velocity(i, j, c)] +=
                quadratic(along.t, a) * quadratic(row.t, b) * unknowns[from.velocity(2 * I + a, 2 * J + b, c)];
      const double up = 0.5 * (1 + row.t);
      if (j % 2 == 0 && j > 0)
        for (int a = 0; a < 3; ++a)
          out[to.height(i, j / 2)] += quadratic(along.t, a) * ((1 - up) * value(from.height(2 * I + a, J)) +
                                                               up * value(from.height(2 * I + a, J + 1)));
      if (i % 2 == 0 && j % 2 == 0)
        out[to.pressure(i / 2, j / 2)] =
            (1 - right) * ((1 - up) * unknowns[from.pressure(I, J)] + up * unknowns[from.pressure(I, J + 1)]) +
            right * ((1 - up) * unknowns[from.pressure(I + 1, J)] + up * unknowns[from.pressure(I + 1, J + 1)]);
    }
    if (i % 2 == 0)
      for (int J = 0; J < to.n_through; ++J)
        for (int k = 0; k < 3; ++k) {
          const double r = to.lines.rows[J], dr = to.lines.rows[J + 1] - r;
          const Place1 row            = place_in(from.lines.rows, r + 0.5 * dr * (1 + shapes.point[k]));
          out[to.strain(i / 2, J, k)] = (1 - right) * strain(I, row) + right * strain(I + 1, row);
        }
    if (to.contact(i) >= 0)
      for (int a = 0; a < 3; ++a)
        if (const int index = from.contact(2 * I + a); index >= 0)
          out[to.contact(i)] += quadratic(along.t, a) * unknowns[index];
  }
  out.tail(n_whole) = unknowns.tail(n_whole);
  for (int u = 0; u < to.n_unknowns; ++u)
    if (to.held[u])
      out[u] = 0;
  return out;
}

StripDirections interpolated(const StripGrid &from, const StripDirections &directions, const StripGrid &to)
{
  StripDirections out;
  out.bulk           = Eigen::MatrixXd::Zero(7, 9 * to.n_along * to.n_through);
  out.slip           = Eigen::MatrixXd::Zero(3, to.last - to.first + 1);
  const VectorXd old = along_strip(from.lines), lines = along_strip(to.lines);
  const StripShapes &shapes = strip_shapes();
  const auto gauss_point    = [&](const VectorXd &values, const int cell, const int k) {
    return values[cell] + 0.5 * (values[cell + 1] - values[cell]) * (1 + shapes.point[k]);
  };
  for (int I = 0; I < to.n_along; ++I)
    for (int J = 0; J < to.n_through; ++J)
      for (int q = 0; q < 9; ++q) {
        const Place1 along = place_in(old, gauss_point(lines, I, q / 3));
        const Place1 row   = place_in(from.lines.rows, gauss_point(to.lines.rows, J, q % 3));
        auto direction     = out.bulk.col((I * to.n_through + J) * 9 + q).tail(3);
        for (int p = 0; p < 9; ++p)
          direction += lagrange(shapes.point, p / 3, along.t) * lagrange(shapes.point, p % 3, row.t) *
                       directions.bulk.col((along.interval * from.n_through + row.interval) * 9 + p).tail(3);
      }
  for (int i = to.first; i <= to.last; ++i) {
    const Place1 along = place_in(old, at_node(lines, i));
    for (int a = 0; a < 3; ++a)
      if (const int k = 2 * along.interval + a; k >= from.first && k <= from.last)
        out.slip(2, i - to.first) += quadratic(along.t, a) * directions.slip(2, k - from.first);
  }
  return out;
}

const StripShapes &strip_shapes()
{
  static const StripShapes shapes = [] {
    StripShapes s;
    const double outer = std::sqrt(0.6);
    s.point << -outer, 0, outer;
    s.weight << 5. / 9, 8. / 9, 5. / 9;
    for (int q = 0; q < 9; ++q) {
      const double x = s.point[q / 3], y = s.point[q % 3];
      for (int n = 0; n < 9; ++n) {
        s.value(q, n)   = quadratic(x, n / 3) * quadratic(y, n % 3);
        s.along(q, n)   = quadratic_slope(x, n / 3) * quadratic(y, n % 3);
        s.through(q, n) = quadratic(x, n / 3) * quadratic_slope(y, n % 3);
      }
      for (int n = 0; n < 4; ++n)
        s.corner(q, n) = 0.25 * (n / 2 ? 1 + x : 1 - x) * (n % 2 ? 1 + y : 1 - y);
    }
    // Integrals of the Lagrange polynomials of the Gauss points up to each point, exact with the same rule.
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l) {
        s.gathered(k, l)  = 0;
        const double half = 0.5 * (s.point[k] + 1);
        for (int q = 0; q < 3; ++q) {
          const double t = -1 + half * (1 + s.point[q]);
          s.gathered(k, l) += half * s.weight[q] * lagrange(s.point, l, t);
        }
      }
    return s;
  }();
  return shapes;
}
}  // namespace mill::fem
