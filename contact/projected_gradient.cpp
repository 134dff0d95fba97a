#include "contact/projected_gradient.h"
#include "core/errors.h"
#include <algorithm>
#include <cmath>
#include <string>

namespace mill::contact {
namespace {
using Eigen::VectorXd;

void require(const OperatorProblem &p, const double value, const VectorXd &start)
{
  const auto n = p.initial_gap.size();
  if (n == 0 || p.G.size() != n || (start.size() != 0 && start.size() != n) || !p.product)
    throw InputError("contact by projection: sizes do not fit");
  if (!p.G.allFinite() || !p.initial_gap.allFinite() || !std::isfinite(value) || !start.allFinite() ||
      !(p.G.array() >= 0).all() || !(p.G.array() > 0).any())
    throw InputError("contact by projection: a number is not finite, or G is negative or zero");
}

[[noreturn]] void not_converged(const int products)
{
  throw SolverError({"contact by projection: not converged",
                     std::to_string(products) + " products with the operator",
                     "an operator that is not symmetric and positive definite, or badly conditioned",
                     "allow more products, or start from a neighbouring load", ""});
}

struct Iteration {
  const OperatorProblem &p;
  double value;
  bool by_motion;
  int most, products = 0;
  VectorXd nodal, open;  // open: initial gap + C nodal
  double motion = 0;

  VectorXd multiply(const VectorXd &x)
  {
    if (++products > most)
      not_converged(products - 1);
    return p.product(x);
  }

  // Motion that makes the mean gap of the active nodes zero, weighed by G; or the imposed one.
  void set_motion(const VectorXd &active)
  {
    const VectorXd G = p.G.cwiseProduct(active);
    if (by_motion)
      motion = value;
    else if (G.squaredNorm() > 0)
      motion = G.dot(open) / G.squaredNorm();
  }

  // The part of a vector over the active nodes that a free motion cannot take up.
  VectorXd projected(const VectorXd &v, const VectorXd &active) const
  {
    VectorXd out = v.cwiseProduct(active);
    if (!by_motion) {
      const VectorXd G = p.G.cwiseProduct(active);
      out -= G * (G.dot(out) / G.squaredNorm());
    }
    return out;
  }

  void balance()
  {
    if (!by_motion)
      nodal *= value / p.G.dot(nodal);
  }

  double length() const
  {
    return std::max((p.G * motion).cwiseAbs().maxCoeff(), (open - p.initial_gap).cwiseAbs().maxCoeff());
  }

  void approach(const double wanted)
  {
    VectorXd t     = VectorXd::Zero(nodal.size());
    double before  = 1;
    bool conjugate = false;
    for (;;) {
      open                  = p.initial_gap + multiply(nodal);
      const VectorXd active = (nodal.array() > 0).cast<double>();
      set_motion(active);
      const VectorXd gap = open - p.G * motion;
      const VectorXd r   = gap.cwiseProduct(active);
      const double size  = r.squaredNorm();
      const double worst = std::max(r.cwiseAbs().maxCoeff(), -gap.minCoeff());
      if (worst <= wanted * length())
        return;
      if (size == 0) {  // nothing touches yet, though it should
        nodal     = (-gap).cwiseMax(0) * (1 / std::max(1e-300, multiply(VectorXd::Ones(gap.size())).maxCoeff()));
        conjugate = false;
        continue;
      }
      t                 = conjugate ? VectorXd(r + (size / before) * t.cwiseProduct(active)) : r;
      before            = size;
      const VectorXd z  = projected(multiply(t), active);
      const double step = r.dot(t) / z.dot(t);
      if (!std::isfinite(step))
        not_converged(products);
      nodal     = (nodal - step * t.cwiseProduct(active)).cwiseMax(0);
      conjugate = true;
      for (Eigen::Index i = 0; i < nodal.size(); ++i)
        if (nodal[i] == 0 && gap[i] < 0) {
          nodal[i]  = -step * gap[i];
          conjugate = false;
        }
      balance();
    }
  }

  // Equality on the active nodes, as far as rounding goes.
  void settle(const VectorXd &active)
  {
    nodal = nodal.cwiseProduct(active);
    balance();
    open = p.initial_gap + multiply(nodal);
    set_motion(active);
    VectorXd r = -projected(open - p.G * motion, active), t = r;
    double size         = r.squaredNorm();
    const double enough = std::pow(1e-15 * length(), 2) * active.sum();
    double best         = size;
    for (int stalled = 0; size > enough && stalled < 20;) {
      const VectorXd z  = projected(multiply(t), active);
      const double step = size / t.dot(z);
      nodal += step * t;
      r -= step * z;
      const double now = r.squaredNorm();
      t                = r + (now / size) * t;
      size             = now;
      stalled          = now < 0.5 * best ? 0 : stalled + 1;
      best             = std::min(best, now);
    }
    open = p.initial_gap + multiply(nodal);
    set_motion(active);
  }
};
}  // namespace

ProjectedState contact_by_projection(const OperatorProblem &p, const double value, const bool by_motion,
                                     const VectorXd &start, const int most_products)
{
  require(p, value, start);
  const auto n = p.initial_gap.size();
  ProjectedState out;
  if (by_motion && (p.initial_gap - p.G * value).minCoeff() >= 0) {
    out.motion = value;
    out.nodal  = VectorXd::Zero(n);
    out.gap    = p.initial_gap - p.G * value;
    out.active.assign(n, 0);
    return out;
  }
  if (!by_motion && !(value > 0))
    throw SolverError({"contact by projection: the imposed resultant needs tension",
                       "resultant " + std::to_string(value), "a contact only presses", "impose the motion", ""});
  Iteration it{p, value, by_motion, most_products, 0, {}, {}, 0};
  it.nodal = start.size() ? VectorXd(start.cwiseMax(0)) : VectorXd(p.G);
  if (it.nodal.maxCoeff() <= 0)
    it.nodal = p.G;
  if (by_motion && start.size() == 0) {  // as much as closes the gap on average
    const VectorXd moved = it.multiply(it.nodal);
    it.nodal *= std::max(0., (p.G * value - p.initial_gap).cwiseMax(0).sum() / moved.sum());
  }
  it.balance();
  it.approach(1e-8);
  for (int round = 0; round < 60; ++round) {
    const VectorXd active = (it.nodal.array() > 0).cast<double>();
    it.settle(active);
    const VectorXd gap  = it.open - p.G * it.motion;
    const double length = it.length();
    const double inside = gap.cwiseProduct(active).cwiseAbs().maxCoeff();
    bool exact          = true;
    VectorXd next       = it.nodal;
    // A gap is known to what is left inside, where it should be zero.
    const double known = std::max(1e-14 * length, 2 * inside);
    const double seed  = 1e-12 * it.nodal.maxCoeff();
    for (Eigen::Index i = 0; i < n; ++i)
      if (active[i] > 0 ? it.nodal[i] < 0 : gap[i] < -known) {
        exact   = false;
        next[i] = active[i] > 0 ? 0 : seed;
      }
    if (!exact) {
      it.nodal = next;
      continue;
    }
    out.motion    = it.motion;
    out.resultant = p.G.dot(it.nodal);
    out.nodal     = it.nodal.cwiseMax(0);
    out.gap       = gap.cwiseMax(0);
    out.products  = it.products;
    out.residual  = std::max(inside, -gap.minCoeff()) / length;
    if (!by_motion)
      out.residual = std::max(out.residual, std::abs(out.resultant / value - 1));
    out.active.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      out.active[i] = active[i] > 0;
      if (out.active[i])
        out.gap[i] = 0;
    }
    return out;
  }
  not_converged(it.products);
}
}  // namespace mill::contact
