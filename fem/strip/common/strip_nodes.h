#pragma once
#include <array>
#include <vector>

// Nodes of a structured strip of biquadratic elements whose rows are streamlines, and the polynomials on them.
namespace mill::fem {
/// n_along x n_through elements with their unknowns.  Node (i, j) is on spine i = 0 .. 2 n_along from the inlet to
/// the outlet, row j = 0 .. 2 n_through from the mid plane; corners are even.
struct StripNodes {
  int n_along = 0, n_through = 0, n_unknowns = 0;
  std::vector<int> velocity_of, height_of;

  int spines() const
  {
    return 2 * n_along + 1;
  }
  int rows() const
  {
    return 2 * n_through + 1;
  }
  int velocity(const int i, const int j, const int component) const
  {
    return velocity_of[2 * (i * rows() + j) + component];
  }
  /// Height of row J on spine i; -1 on the mid plane.
  int height(const int i, const int J) const
  {
    return J == 0 ? -1 : height_of[i * n_through + J - 1];
  }
};

/// Quadratic Lagrange polynomial of node a = 0, 1, 2 at -1, 0, 1, and its derivative.
inline double quadratic(const double t, const int a)
{
  return a == 0 ? 0.5 * t * (t - 1) : a == 1 ? 1 - t * t : 0.5 * t * (t + 1);
}
inline double quadratic_slope(const double t, const int a)
{
  return a == 0 ? t - 0.5 : a == 1 ? -2 * t : t + 0.5;
}

/// Lagrange polynomial l of any three points at t.
template <class Points> double lagrange(const Points &points, const int l, const double t)
{
  double value = 1;
  for (int m = 0; m < 3; ++m)
    if (m != l)
      value *= (t - points[m]) / (points[l] - points[m]);
  return value;
}
}  // namespace mill::fem
