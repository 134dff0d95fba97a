#include "reduce/bearing/oil_film/parabolic_film.h"
#include "core/base/errors.h"
#include "core/numerics/root_search.h"
#include <cmath>
#include <vector>

namespace mill::bearing {
namespace {
constexpr int n_angles = 720;

// The pressure from `first` to `last`, both excluded nodes of zero pressure: tridiagonal.
void solve_between(const std::vector<double> &right, const std::vector<double> &diagonal,
                   const std::vector<double> &rhs, const int first, const int last, std::vector<double> &g)
{
  std::vector<double> ratio(g.size(), 0.), part(g.size(), 0.);
  g.assign(g.size(), 0.);
  for (int i = first + 1; i < last; ++i) {  // right[i]: conductance from i to i + 1
    const double left     = right[std::size_t(i - 1)];
    const double pivot    = diagonal[std::size_t(i)] - (i > first + 1 ? left * ratio[std::size_t(i - 1)] : 0);
    ratio[std::size_t(i)] = right[std::size_t(i)] / pivot;
    part[std::size_t(i)]  = (rhs[std::size_t(i)] + (i > first + 1 ? left * part[std::size_t(i - 1)] : 0)) / pivot;
  }
  for (int i = last - 1; i > first; --i)
    g[std::size_t(i)] = part[std::size_t(i)] + ratio[std::size_t(i)] * (i + 1 < last ? g[std::size_t(i + 1)] : 0);
}
}  // namespace

Eigen::Vector2d parabolic_force(const double length_ratio, const double e)
{
  require_input(e >= 0 && e < 1, "an eccentricity ratio lies between 0 and 1");
  // Angles t from the widest gap, from -pi/2 to 3 pi/2, where the gap opens most and nothing carries.
  const double step = 2 * M_PI / n_angles;
  const auto angle  = [&](const double i) { return -M_PI / 2 + i * step; };
  const auto gap    = [&](const double i) { return 1 + e * std::cos(angle(i)); };
  std::vector<double> right(n_angles + 1), diagonal(n_angles + 1), rhs(n_angles + 1), g(n_angles + 1);
  for (int i = 0; i <= n_angles; ++i)
    right[std::size_t(i)] = std::pow(gap(i + 0.5), 3) / step;
  for (int i = 1; i < n_angles; ++i) {
    diagonal[std::size_t(i)] = right[std::size_t(i - 1)] + right[std::size_t(i)] +
                               2.5 / (length_ratio * length_ratio) * std::pow(gap(i), 3) * step;
    rhs[std::size_t(i)] = -7.5 * (gap(i + 0.5) - gap(i - 0.5));
  }
  // One arc carries.  Its ends move by one node until nothing pulls inside and nothing would flow in outside.
  int first = n_angles / 4, last = 3 * n_angles / 4;
  for (int turn = 0; turn < 4 * n_angles; ++turn) {
    solve_between(right, diagonal, rhs, first, last, g);
    const auto value_at = [&](const int i) { return g[std::size_t(i)]; };
    const auto gains    = [&](const int i, const double neighbour) {  // an end that would carry
      return rhs[std::size_t(i)] + neighbour > 0;
    };
    int moved = 0;
    if (first > 1 && gains(first, right[std::size_t(first)] * value_at(first + 1)))
      --first, ++moved;
    else if (value_at(first + 1) < 0)
      ++first, ++moved;
    if (last < n_angles - 1 && gains(last, right[std::size_t(last - 1)] * value_at(last - 1)))
      ++last, ++moved;
    else if (value_at(last - 1) < 0)
      --last, ++moved;
    if (moved == 0)
      break;
  }
  Eigen::Vector2d force(0, 0);
  for (int i = 1; i < n_angles; ++i)
    force += 4. / 3 * step * g[std::size_t(i)] * Eigen::Vector2d(-std::cos(angle(i)), -std::sin(angle(i)));
  return force;
}

double parabolic_eccentricity(const double length_ratio, const double force)
{
  constexpr double low = 1e-6, high = 0.999;
  const auto excess = [&](const double e) { return parabolic_force(length_ratio, e).norm() - force; };
  return root_between(low, high, excess).value_or(excess(low) > 0 ? low : high);
}
}  // namespace mill::bearing
