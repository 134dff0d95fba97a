#include "dynamics/cluster/motion_equations.h"
#include <algorithm>
#include <cmath>

namespace mill::cluster {
namespace {
double odd_power(const double d, const double kappa, const double power)
{
  return power == 1 ? d / kappa : std::copysign(std::pow(std::abs(d) / kappa, power), d);
}
}  // namespace

MotionEquations::MotionEquations(const Stack &stack, const Motion &rest, const std::vector<Drive> &drives)
    : n_(2 * int(stack.rolls.size())), stack_(stack)
{
  stack_.coupled = false;
  mass_          = masses(stack_);
  constant_      = forces(stack_, rest).loads;
  for (const Contact &c : stack_.contacts) {
    const ContactState s = contact_state(stack_, c, rest);
    if (c.strip && c.free_length == 0)
      continue;
    contacts_.push_back({c.a, c.b, c.law, s.distance * s.normal.x(), s.distance * s.normal.y(), s.distance,
                         s.approach, c.damping, c.depth, c.one_sided, c.carried, 0, 0});
  }
  for (const Support &s : stack_.supports) {
    OneSupport support{s.roll,
                       s.type,
                       s.law.kappa,
                       1 / s.law.q,
                       rest[2 * s.roll] - s.anchor.x(),
                       rest[2 * s.roll + 1] - s.anchor.y(),
                       {std::cos(s.direction), 0},
                       {std::sin(s.direction), 0},
                       s.preload > 0 ? s.law.kappa * std::pow(s.preload, s.law.q) : 0,
                       s.across,
                       s.guard};
    if (s.type == Support::Type::rollers) {
      const auto t = roller_directions(s);
      for (std::size_t k = 0; k < 2; ++k) {
        support.tx[k] = t[k].x();
        support.ty[k] = t[k].y();
      }
    }
    supports_.push_back(support);
  }
  for (const Drive &d : drives)
    if (d.strip >= 0) {
      contacts_[std::size_t(d.strip)].drive = d.force.norm();
      contacts_[std::size_t(d.strip)].omega = 2 * M_PI * d.frequency;
    } else
      drives_.push_back({d.roll, d.force.x(), d.force.y(), 2 * M_PI * d.frequency});
}

MotionEquations::Now MotionEquations::now(const OneContact &c, const double *state, const int n)
{
  const double *u = state, *v = state + n;
  const double dx = u[2 * c.b] - u[2 * c.a], dy = u[2 * c.b + 1] - u[2 * c.a + 1];
  const double x = c.x + dx, y = c.y + dy, z = std::sqrt(x * x + y * y);
  const double longer = lengthened(c.x, c.y, dx, dy, c.distance, z);
  Now s;
  s.nx       = x / z;
  s.ny       = y / z;
  s.approach = c.approach - longer;
  s.rate     = -(s.nx * (v[2 * c.b] - v[2 * c.a]) + s.ny * (v[2 * c.b + 1] - v[2 * c.a + 1]));
  return s;
}

double MotionEquations::elastic_force(const OneContact &c, const double approach)
{
  if (c.carried > 0)
    return std::max(-c.carried, c.law.k * approach);
  return c.one_sided || approach > 0 ? force(c.law, approach) : c.law.k * approach;
}

// Of the strip: what it pushes in addition to the loads.  (38.26)
double MotionEquations::pushing(const OneContact &c, const Now &s, const double time)
{
  if (c.carried > 0)
    return std::max(-c.carried, c.law.k * s.approach + c.damping * s.rate + c.drive * std::sin(c.omega * time));
  if (!c.one_sided)
    return elastic_force(c, s.approach) + c.damping * s.rate;
  return c.damping == 0 ? force(c.law, s.approach) : impact_force(c.law, s.approach, s.rate, c.damping, c.depth);
}

void MotionEquations::support_force(const OneSupport &s, const double dx, const double dy, double *force)
{
  const double x = s.x + dx, y = s.y + dy;
  switch (s.type) {
  case Support::Type::radial: {
    const double r = std::sqrt(x * x + y * y), share = r > 0 ? odd_power(r, s.kappa, s.power) / r : 0;
    force[0] -= share * x;
    force[1] -= share * y;
    return;
  }
  case Support::Type::isotropic:
    force[0] -= s.across * x;
    force[1] -= odd_power(y, s.kappa, s.power);
    return;
  case Support::Type::guide: {
    const double f = odd_power(s.tx[0] * x + s.ty[0] * y, s.kappa, s.power);
    force[0] -= f * s.tx[0];
    force[1] -= f * s.ty[0];
    return;
  }
  case Support::Type::rollers:
    force[0] -= s.guard * x;
    force[1] -= s.guard * y;
    for (int k = 0; k < 2; ++k)
      if (const double d = s.tx[k] * x + s.ty[k] * y + s.d0; d > 0) {
        const double f = odd_power(d, s.kappa, s.power);
        force[0] -= f * s.tx[k];
        force[1] -= f * s.ty[k];
      }
    return;
  }
}

void MotionEquations::slope(const double time, const double *state, double *slope) const
{
  const double *u = state, *v = state + n_;
  double *f = slope + n_, *sums = slope + 2 * n_;  // sums: power, outer force x and y
  std::copy(v, v + n_, slope);
  std::copy(constant_.data(), constant_.data() + n_, f);
  sums[0] = sums[1] = sums[2] = 0;
  for (const OneSupport &s : supports_)
    support_force(s, u[2 * s.roll], u[2 * s.roll + 1], f + 2 * s.roll);
  for (const OneDrive &d : drives_) {
    const double factor = std::sin(d.omega * time);
    f[2 * d.roll] += factor * d.x;
    f[2 * d.roll + 1] += factor * d.y;
    sums[0] += factor * (d.x * v[2 * d.roll] + d.y * v[2 * d.roll + 1]);
  }
  for (int i = 0; i < n_; i += 2) {
    sums[1] += f[i];
    sums[2] += f[i + 1];
  }
  for (const OneContact &c : contacts_) {
    const Now s = now(c, state, n_);
    if (c.one_sided && s.approach <= 0)
      continue;
    const double push = pushing(c, s, time);
    if (c.damping != 0 || c.drive != 0)
      sums[0] -= (push - elastic_force(c, s.approach)) * s.rate;
    f[2 * c.a] -= push * s.nx;
    f[2 * c.a + 1] -= push * s.ny;
    f[2 * c.b] += push * s.nx;
    f[2 * c.b + 1] += push * s.ny;
  }
  for (int i = 0; i < n_; ++i)
    f[i] /= mass_[i];
}

void MotionEquations::approaches(const double time, const double *state, double *approach) const
{
  for (const OneContact &c : contacts_) {
    const Now s = now(c, state, n_);
    *approach++ =
        c.carried > 0 ? s.approach + (c.carried + c.drive * std::sin(c.omega * time)) / c.law.k : s.approach;
  }
}

void MotionEquations::contact_forces(const double time, const double *state, double *forces) const
{
  for (const OneContact &c : contacts_)
    *forces++ = c.carried + pushing(c, now(c, state, n_), time);
}

double MotionEquations::stored(const OneContact &c, const double d)
{
  if (c.carried > 0) {
    const double opens = -c.carried / c.law.k;
    return d > opens ? 0.5 * c.law.k * d * d : 0.5 * c.law.k * opens * opens - c.carried * (d - opens);
  }
  return !c.one_sided && d < 0 ? 0.5 * c.law.k * d * d : mill::cluster::energy(c.law, d);
}

double MotionEquations::stored(const OneSupport &s, const double x, const double y)
{
  const auto energy = [&](const double d) { return odd_power(d, s.kappa, s.power) * d / (1 + s.power); };
  switch (s.type) {
  case Support::Type::radial:
    return energy(std::sqrt(x * x + y * y));
  case Support::Type::isotropic:
    return 0.5 * s.across * x * x + energy(y);
  case Support::Type::guide:
    return energy(s.tx[0] * x + s.ty[0] * y);
  case Support::Type::rollers: {
    double sum = 0.5 * s.guard * (x * x + y * y);
    for (int k = 0; k < 2; ++k)
      if (const double d = s.tx[k] * x + s.ty[k] * y + s.d0; d > 0)
        sum += energy(d);
    return sum;
  }
  }
  return 0;
}

// Differences from rest, part by part: the whole stores some 1e5 times what vibrates.
double MotionEquations::energy(const double *state) const
{
  const Eigen::Map<const Eigen::VectorXd> u(state, n_), v(state + n_, n_);
  double sum = 0.5 * v.dot(mass_.cwiseProduct(v)) - constant_.dot(u);
  for (const OneContact &c : contacts_)
    sum += stored(c, now(c, state, n_).approach) - stored(c, c.approach);
  for (const OneSupport &s : supports_)
    sum += stored(s, s.x + u[2 * s.roll], s.y + u[2 * s.roll + 1]) - stored(s, s.x, s.y);
  return sum;
}
}  // namespace mill::cluster
