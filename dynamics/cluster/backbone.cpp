#include "dynamics/cluster/backbone.h"
#include "core/numerics/eigen_instances.h"
#include "dynamics/cluster/modes.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::cluster {
namespace {
// q_0 .. q_H one after the other, then omega^2: u(t) = u_0 + sum of q_k cos(k omega t).
struct Balance {
  const Stack &stack;
  const Motion &rest;
  Eigen::VectorXd m;
  BackboneOptions options;
  Eigen::Index n, largest;
  Eigen::MatrixXd cosines;  // samples x harmonics

  Balance(const Stack &s, const Motion &u, const BackboneOptions &o, const Eigen::Index l)
      : stack(s), rest(u), m(masses(s)), options(o), n(m.size()), largest(l), cosines(o.samples, o.harmonics + 1)
  {
    for (int t = 0; t < o.samples; ++t)
      for (int k = 0; k <= o.harmonics; ++k)
        cosines(t, k) = std::cos(k * M_PI * (t + 0.5) / o.samples);
  }

  Motion state(const Eigen::VectorXd &q, const int t) const
  {
    Motion u = rest;
    for (int k = 0; k <= options.harmonics; ++k)
      u += cosines(t, k) * q.segment(n * k, n);
    return u;
  }

  double weight(const int k) const
  {
    return (k == 0 ? 1. : 2.) / options.samples;
  }

  // (38.19): the last equation fixes the amplitude.
  void assemble(const Eigen::VectorXd &q, const double amplitude, Eigen::VectorXd &r, Eigen::MatrixXd &J) const
  {
    const int H       = options.harmonics;
    const double root = q[n * (H + 1)];
    r                 = Eigen::VectorXd::Zero(q.size());
    J                 = Eigen::MatrixXd::Zero(q.size(), q.size());
    for (int t = 0; t < options.samples; ++t) {
      const Motion u          = state(q, t);
      const Eigen::VectorXd f = forces(stack, u).total;
      const Eigen::MatrixXd K = total_tangent(stack, u);
      for (int k = 0; k <= H; ++k) {
        r.segment(n * k, n) -= weight(k) * cosines(t, k) * f;
        for (int l = 0; l <= H; ++l)
          J.block(n * k, n * l, n, n) += weight(k) * cosines(t, k) * cosines(t, l) * K;
      }
    }
    for (int k = 1; k <= H; ++k) {
      const Eigen::VectorXd inertia = k * k * m.cwiseProduct(q.segment(n * k, n));
      r.segment(n * k, n) -= root * inertia;
      J.block(n * k, n * k, n, n).diagonal() -= root * k * k * m;
      J.block(n * k, n * (H + 1), n, 1) = -inertia;
    }
    r[n * (H + 1)]              = q[n + largest] - amplitude;
    J(n * (H + 1), n + largest) = 1;
  }

  BackbonePoint point(const Eigen::VectorXd &q) const
  {
    BackbonePoint p;
    p.amplitude  = q[n + largest];
    p.frequency  = std::sqrt(q[n * (options.harmonics + 1)]) / (2 * M_PI);
    p.mean_shift = q[largest];
    p.second     = q[2 * n + largest] / p.amplitude;
    for (int k = 0; k <= options.harmonics; ++k) {
      p.highest += q[n * k + largest];
      p.lowest += (k % 2 ? -1 : 1) * q[n * k + largest];
    }
    p.least_approach = std::numeric_limits<double>::infinity();
    for (int t = 0; t < options.samples; ++t)
      for (const Contact &c : stack.contacts)
        if (const double d = before_opening(c, state(q, t)); d < p.least_approach) {
          p.least_approach = d;
          p.lets_go        = d < 0 ? c.name : "";
        }
    return p;
  }

  // m, approach from where the whole force is zero; of the strip, whose approach is from the state at rest,
  // (38.26).
  double before_opening(const Contact &c, const Motion &u) const
  {
    const double approach = contact_state(stack, c, u).approach;
    if (!c.strip)
      return approach;
    return c.law.k > 0 ? approach + c.carried / c.law.k : std::numeric_limits<double>::infinity();
  }
};

bool solve_balance(const Balance &balance, const double amplitude, Eigen::VectorXd &q)
{
  Eigen::VectorXd r;
  Eigen::MatrixXd J;
  for (int step = 0; step < 25; ++step) {
    balance.assemble(q, amplitude, r, J);
    const Eigen::VectorXd dq = J.partialPivLu().solve(r);
    if (!dq.allFinite())
      return false;
    q -= dq;
    const double moved = dq.head(q.size() - 1).cwiseAbs().maxCoeff();
    // Forces are sums of numbers up to 1e6 N over 1e10 N/m: displacements have 1e-15 m.
    const double noise = 1e-15;
    if (moved < 1e-10 * amplitude + noise &&
        std::abs(dq[q.size() - 1]) < (1e-10 + noise / amplitude) * std::abs(q[q.size() - 1]))
      return q[q.size() - 1] > 0;
  }
  return false;
}
}  // namespace

std::vector<BackbonePoint> backbone(const Stack &stack, const Motion &u, const int mode,
                                    const std::vector<double> &amplitudes, const BackboneOptions &options)
{
  Stack flat        = stack;
  flat.coupled      = false;
  const Mode linear = modes(flat, u)[std::size_t(mode)];
  Eigen::Index largest;
  linear.shape.cwiseAbs().maxCoeff(&largest);
  const Balance balance(flat, u, options, largest);
  Eigen::VectorXd q = Eigen::VectorXd::Zero(balance.n * (options.harmonics + 1) + 1);
  q[q.size() - 1]   = std::pow(2 * M_PI * linear.frequency, 2);
  std::vector<BackbonePoint> points;
  double before = 0;
  for (const double amplitude : amplitudes) {
    if (before == 0)
      q.segment(balance.n, balance.n) = amplitude * linear.shape;
    else
      q.head(q.size() - 1) *= amplitude / before;
    if (!solve_balance(balance, amplitude, q))
      break;
    points.push_back(balance.point(q));
    before = amplitude;
  }
  return points;
}
}  // namespace mill::cluster
