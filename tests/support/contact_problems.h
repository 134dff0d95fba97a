#pragma once
#include "core/base/errors.h"
#include "fem/contact/half_space.h"
#include "fem/contact/problem.h"
#include <cmath>
#include <random>

// Contact problems that several tests and the benchmark share.
namespace contact_problems {
inline const mill::Material steel{210e9, 0.3, 7800};

/// Elastic half spaces, rectangles of sides 2 hx by 2 hy on a grid of nx by ny, flat.  One driven mode: the
/// approach.
inline mill::contact::Problem grid(const int nx, const int ny, const double hx, const double hy)
{
  const auto bodies = mill::contact::half_spaces(steel, steel);
  Eigen::MatrixXd kernel(nx, ny);
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      kernel(i, j) =
          bodies.normal * mill::contact::kernel_integrals({hx, hy}, 2 * hx * i, 2 * hy * j).one / (4 * hx * hy);
  mill::contact::Problem p;
  const int n = nx * ny;
  p.C.resize(n, n);
  for (int b = 0; b < n; ++b)
    for (int a = 0; a < n; ++a)
      p.C(a, b) = kernel(std::abs(a % nx - b % nx), std::abs(a / nx - b / nx));
  p.G           = Eigen::MatrixXd::Ones(n, 1);
  p.initial_gap = Eigen::VectorXd::Zero(n);
  return p;
}

/// Coordinates of node i of the grid, middle at 0.
inline Eigen::Vector2d place(const int i, const int nx, const int ny, const double hx, const double hy)
{
  return {(2 * (i % nx) - nx + 1) * hx, (2 * (i / nx) - ny + 1) * hy};
}

/// Sphere of radius 10 mm on a flat, n by n squares over a square of side 2 `half`.
inline mill::contact::Problem sphere(const int n, const double half)
{
  const double h = half / n;
  auto p         = grid(n, n, h, h);
  for (int i = 0; i < n * n; ++i)
    p.initial_gap[i] = place(i, n, n, h, h).squaredNorm() / (2 * 0.010);
  return p;
}

/// Roll pair: relative radius 150 mm, crown (0.05 mm) at the ends of 1.4 m; approach and tilt are driven.
inline mill::contact::Problem roll_pair(const int nx, const int nz, const double half_width)
{
  const double hx = half_width / nx, hz = 0.7 / nz;
  auto p = grid(nx, nz, hx, hz);
  p.G.conservativeResize(Eigen::NoChange, 2);
  for (int i = 0; i < nx * nz; ++i) {
    const Eigen::Vector2d x = place(i, nx, nz, hx, hz);
    p.G(i, 1)               = x[1];
    p.initial_gap[i]        = x[0] * x[0] / (2 * 0.150) + 0.05e-3 * x[1] * x[1] / (0.7 * 0.7);
  }
  return p;
}

/// Points at random in a square with a kernel that decays, k driven modes (approach, two tilts) and a rough bowl.
inline mill::contact::Problem rough(const int n, const int k, const unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> u(-1, 1);
  Eigen::MatrixXd x(n, 2);
  for (int i = 0; i < n; ++i)
    x.row(i) << u(random), u(random);
  mill::contact::Problem p;
  p.C.resize(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      p.C(i, j) = 1 / std::sqrt(1 + 16 * (x.row(i) - x.row(j)).squaredNorm()) + (i == j ? 1e-3 : 0.);
  p.G = Eigen::MatrixXd::Ones(n, k);
  for (int j = 1; j < k; ++j)
    p.G.col(j) = x.col(j - 1);
  p.initial_gap = Eigen::VectorXd::NullaryExpr(
      n, [&](const Eigen::Index i) { return x.row(i).squaredNorm() + 0.1 * u(random); });
  return p;
}

inline Eigen::VectorXd one(const double value)
{
  return Eigen::VectorXd::Constant(1, value);
}
}  // namespace contact_problems
