#include "tests/manual/bite/free_arc_slab.h"
#include "core/base/errors.h"
#include "core/laws/flow_stress_law.h"
#include <Eigen/Dense>
#include <cmath>

namespace mill::verify {
namespace {
using Eigen::VectorXd;

// x runs along the strip, x = 0 on the line of centres; the gap of the loaded rolls between even points.
struct Gap {
  VectorXd x, h;
  double step;
  int thinnest;
};

struct Law {
  const Strip &s;
  double stiff, across;
  bool coupled;
  explicit Law(const Strip &strip, const bool c)
      : s(strip), stiff(strip.youngs_modulus / (1 - strip.poisson_ratio * strip.poisson_ratio)),
        across(strip.poisson_ratio / (1 - strip.poisson_ratio)), coupled(c)
  {
  }
  double yield(const double h) const
  {
    return bite::flow_stress(s.flow_stress, std::log(s.entry_thickness / std::min(h, s.entry_thickness)));
  }
};

// One end or one branch: stress along the strip and pressure, stepped from a point to its neighbour by Heun's
// rule.
struct Slice {
  double along, p;
};

// d(h s) = -p dh +- 2 mu p dx, so  ds = ( -(s + p) dh +- 2 mu p dx )/h;  side: +1 behind the neutral point, -1
// before
double change_along(const Law &law, const Slice &slice, const double h, const double dh, const double dx,
                    const int side)
{
  return (-(slice.along + slice.p) * dh + side * 2 * law.s.friction.coefficient * slice.p * dx) / h;
}

Slice elastic_step(const Law &law, const Slice &from, const double h0, const double h1, const double dx,
                   const int side)
{
  const double dh = h1 - h0, mean = 0.5 * (h0 + h1),
               squeeze = -law.stiff * dh / (law.coupled ? mean : law.s.exit_thickness);
  Slice to             = from;
  for (int i = 0; i < 3; ++i) {
    const Slice middle{0.5 * (from.along + to.along), 0.5 * (from.p + to.p)};
    const double ds = law.coupled ? change_along(law, middle, mean, dh, dx, side) : 0;
    to              = {from.along + ds, from.p + squeeze - law.across * ds};
  }
  return to;
}

Slice plastic_step(const Law &law, const Slice &from, const double h0, const double h1, const double dx,
                   const int side)
{
  Slice to = from;
  for (int i = 0; i < 4; ++i) {
    const Slice middle{0.5 * (from.along + to.along), 0.5 * (from.p + to.p)};
    to.along = from.along + change_along(law, middle, 0.5 * (h0 + h1), h1 - h0, dx, side);
    to.p     = law.yield(h1) - to.along;
  }
  return to;
}

// Elastic end behind the thinnest place, from the pressure there: what is left of the tension where it has fallen
// to nothing.
double tension_left(const Law &law, const Gap &g, const double p0, VectorXd *pressure, double *end)
{
  Slice slice{law.yield(g.h[g.thinnest]) - p0, p0};
  for (int i = g.thinnest; i + 1 < g.x.size(); ++i) {
    if (pressure)
      (*pressure)[i] = slice.p;
    const Slice next = elastic_step(law, slice, g.h[i], g.h[i + 1], g.step, 1);
    if (next.p <= 0) {
      const double share = slice.p / (slice.p - next.p);
      if (end)
        *end = g.x[i] + share * g.step;
      return slice.along + share * (next.along - slice.along);
    }
    slice = next;
  }
  return INFINITY;
}

// Pressures that the slab gives on a gap.
VectorXd answer(const Law &law, const Gap &g, FreeArcSlab &out)
{
  const int n    = int(g.x.size());
  const double k = law.yield(g.h[g.thinnest]);
  VectorXd exit = VectorXd::Constant(n, INFINITY), entry = exit;
  double low  = 0,
         high = k + 1e9;  // pressure at the thinnest place: the more of it, the less tension there and behind
  for (int i = 0; law.coupled && i < 60; ++i) {
    const double p0                                                                = 0.5 * (low + high);
    (tension_left(law, g, p0, nullptr, nullptr) > law.s.exit_tension ? low : high) = p0;
  }
  const double p0 = law.coupled ? 0.5 * (low + high) : k - law.s.exit_tension;
  exit.setConstant(INFINITY);
  exit.tail(n - g.thinnest).setZero();
  tension_left(law, g, p0, &exit, &out.exit);
  out.exit_gain = k - p0 - law.s.exit_tension;
  Slice slice{k - p0, p0};
  for (int i = g.thinnest; i > 0 && g.h[i - 1] < law.s.entry_thickness; --i) {
    slice       = plastic_step(law, slice, g.h[i], g.h[i - 1], -g.step, 1);
    exit[i - 1] = slice.p;
  }
  // Entry: met where the gap is the strip's thickness, elastic until it yields.
  entry.setZero();
  int first = g.thinnest;
  while (first > 0 && g.h[first] < law.s.entry_thickness)
    --first;
  const double share = (g.h[first] - law.s.entry_thickness) / (g.h[first] - g.h[first + 1]);
  out.entry          = -(g.x[first] + share * g.step);
  slice              = {law.s.entry_tension, 0};
  bool yields        = false;
  for (int i = first; i < g.thinnest; ++i) {
    const double from = i == first ? law.s.entry_thickness : g.h[i],
                 dx   = i == first ? (1 - share) * g.step : g.step;
    if (!yields) {
      slice  = elastic_step(law, slice, from, g.h[i + 1], dx, -1);
      yields = slice.along + slice.p >= law.yield(from);
      if (yields)
        slice.p = law.yield(g.h[i + 1]) - slice.along;
    } else
      slice = plastic_step(law, slice, from, g.h[i + 1], dx, -1);
    entry[i + 1] = slice.p;
  }
  entry.tail(n - 1 - g.thinnest).setConstant(INFINITY);
  return entry.cwiseMin(exit);
}
}  // namespace

FreeArcSlab slab_on_free_arc(const bite::RollBite &bite, const int points, const bool coupled)
{
  const Law law(bite.strip, coupled);
  const double R = bite.roll_radius, L = std::sqrt(R * (law.s.entry_thickness - law.s.exit_thickness));
  Gap g;
  g.x    = VectorXd::LinSpaced(points, -2.4 * L, 0.8 * L);
  g.step = g.x[1] - g.x[0];
  // Constant pressure on segments, (3.1) of the derivation: u_i = A sum p_j [ 2c - (a ln|a| - b ln|b|) ]
  const Material &roll = bite.roll;
  const double A       = 2 * (1 - roll.poisson_ratio * roll.poisson_ratio) / (M_PI * roll.youngs_modulus);
  VectorXd by_distance(points);
  for (int m = 0; m < points; ++m) {
    const double a = (m + 0.5) * g.step, b = (m - 0.5) * g.step;
    by_distance[m] = A * (g.step - (a * std::log(a) - b * std::log(std::abs(b))));
  }
  Eigen::MatrixXd C(points, points);
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j)
      C(i, j) = by_distance[std::abs(i - j)];
  VectorXd p = VectorXd::Zero(points);
  FreeArcSlab out;
  for (out.passes = 1; out.passes <= 20000; ++out.passes) {
    g.h                = (g.x.array().square() / R).matrix() + 2 * C * p;
    const double least = g.h.minCoeff(&g.thinnest);
    g.h.array() += law.s.exit_thickness - least;
    const VectorXd q    = answer(law, g, out);
    const double change = (q - p).norm() / q.norm();
    p += 0.05 * (q - p);
    if (change < 1e-7) {
      out.force = p.sum() * g.step;
      out.peak  = p.maxCoeff();
      return out;
    }
  }
  throw SolverError(
      {"slab on a free arc: not at rest after 20000 passes", "", "points too far apart", "more points", ""});
}
}  // namespace mill::verify
