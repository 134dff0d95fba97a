#include "dynamics/cluster/stack.h"
#include <algorithm>
#include <cmath>

namespace mill::cluster {
namespace {
// The state at rest has two unknowns per roll also where a vibration turns the rolls.
Eigen::Vector2d at(const Motion &u, const Stack &stack, const int roll)
{
  return u.segment<2>(u.size() / Eigen::Index(stack.rolls.size()) * roll);
}

// A symmetric 2x2 block between two rolls: + on the diagonal, - off it.
void add_pair(Eigen::MatrixXd &K, const Stack &stack, const Contact &c, const Eigen::Matrix2d &block)
{
  const int a = stack.per_roll() * c.a, b = stack.per_roll() * c.b;
  K.block<2, 2>(a, a) += block;
  K.block<2, 2>(b, b) += block;
  K.block<2, 2>(a, b) -= block;
  K.block<2, 2>(b, a) -= block;
}

void add_contact(const Stack &stack, const Contact &c, const Motion &u, Eigen::MatrixXd &K,
                 Eigen::MatrixXd *geometric)
{
  const ContactState s = contact_state(stack, c, u);
  if (c.is_open(s.approach))
    return;
  const double f = added_force(c, s.approach), k = contact_tangent(c, s.approach);
  const Eigen::Matrix2d e = s.normal * s.normal.transpose();
  const Eigen::Matrix2d g = -f / s.distance * (Eigen::Matrix2d::Identity() - e);
  add_pair(K, stack, c, k * e + g);  // (38.9)
  if (geometric)
    add_pair(*geometric, stack, c, g);
  if (stack.coupled && c.tangential > 0) {
    const Eigen::VectorXd row = slip_row(stack, c, s.normal);
    K += c.tangential * k * row * row.transpose();
  }
}

Eigen::Matrix2d support_tangent(const Support &s, const Eigen::Vector2d &u)
{
  switch (s.type) {
  case Support::Type::radial: {
    const Eigen::Vector2d d = u - s.anchor;
    const double r          = d.norm();
    if (s.law.q == 1 || r == 0)
      return Eigen::Matrix2d::Identity() * (s.law.q == 1 ? 1 / s.law.kappa : 0);
    const Eigen::Matrix2d e = d * d.transpose() / (r * r);
    return bearing_tangent(s.law, r) * e + bearing_secant(s.law, r) * (Eigen::Matrix2d::Identity() - e);
  }
  case Support::Type::isotropic:
    return Eigen::Vector2d(s.across, bearing_tangent(s.law, u.y() - s.anchor.y())).asDiagonal();
  case Support::Type::guide: {
    const Eigen::Vector2d t(std::cos(s.direction), std::sin(s.direction));
    return bearing_tangent(s.law, t.dot(u - s.anchor)) * t * t.transpose();
  }
  case Support::Type::rollers: {
    Eigen::Matrix2d K = s.guard * Eigen::Matrix2d::Identity();
    const double d0   = s.law.kappa * std::pow(s.preload, s.law.q);
    for (const Eigen::Vector2d &t : roller_directions(s))
      if (const double d = t.dot(u - s.anchor) + d0; d > 0)
        K += bearing_tangent(s.law, d) * t * t.transpose();
    return K;
  }
  }
  return Eigen::Matrix2d::Zero();
}

double support_energy(const Support &s, const Eigen::Vector2d &u)
{
  const Eigen::Vector2d d = u - s.anchor;
  switch (s.type) {
  case Support::Type::radial:
    return bearing_energy(s.law, d.norm());
  case Support::Type::isotropic:
    return 0.5 * s.across * d.x() * d.x() + bearing_energy(s.law, d.y());
  case Support::Type::guide:
    return bearing_energy(s.law, d.dot(Eigen::Vector2d(std::cos(s.direction), std::sin(s.direction))));
  case Support::Type::rollers: {
    double sum      = 0.5 * s.guard * d.squaredNorm();
    const double d0 = s.law.kappa * std::pow(s.preload, s.law.q);
    for (const Eigen::Vector2d &t : roller_directions(s))
      if (const double value = t.dot(d) + d0; value > 0)
        sum += bearing_energy(s.law, value);
    return sum;
  }
  }
  return 0;
}
}  // namespace

BearingLaw bearing_through(const double tangent, const double force, const double q)
{
  return {q == 1 ? 1 / tangent : std::pow(force, 1 - q) / (q * tangent), q};
}

double bearing_force(const BearingLaw &law, const double d)
{
  if (law.q == 1)
    return d / law.kappa;
  return std::copysign(std::pow(std::abs(d) / law.kappa, 1 / law.q), d);
}

double bearing_secant(const BearingLaw &law, const double d)
{
  return law.q == 1 ? 1 / law.kappa : std::pow(std::abs(d) / law.kappa, 1 / law.q) / std::abs(d);
}

double bearing_tangent(const BearingLaw &law, const double d)
{
  if (law.q == 1)
    return 1 / law.kappa;
  return d == 0 ? 0 : bearing_secant(law, d) / law.q;
}

double bearing_energy(const BearingLaw &law, const double d)
{
  return bearing_force(law, d) * d / (1 + 1 / law.q);
}

Eigen::VectorXd masses(const Stack &stack)
{
  Eigen::VectorXd m(stack.size());
  for (std::size_t i = 0; i < stack.rolls.size(); ++i) {
    const Roll &roll = stack.rolls[i];
    const int index  = stack.per_roll() * int(i);
    m.segment<2>(index).setConstant(roll.mass);
    if (stack.coupled)
      m[index + 2] = roll.inertia / (roll.radius * roll.radius);
  }
  return m;
}

ContactState contact_state(const Stack &stack, const Contact &c, const Motion &u)
{
  const auto a = std::size_t(c.a), b = std::size_t(c.b);
  const Eigen::Vector2d apart = stack.rolls[b].centre - stack.rolls[a].centre,
                        d     = at(u, stack, c.b) - at(u, stack, c.a);
  const Eigen::Vector2d r     = apart + d;
  ContactState s;
  s.distance         = r.norm();
  s.normal           = r / s.distance;
  const double drawn = apart.norm();
  s.approach         = c.free_length - drawn - lengthened(apart.x(), apart.y(), d.x(), d.y(), drawn, s.distance);
  return s;
}

double contact_force(const Contact &c, const double approach)
{
  return c.carried + added_force(c, approach);
}

double added_force(const Contact &c, const double approach)
{
  if (c.strip)  // (38.26)
    return c.free_length == 0 ? 0 : std::max(-c.carried, c.law.k * approach);
  return c.one_sided || approach > 0 ? force(c.law, approach) : c.law.k * approach;
}

double contact_tangent(const Contact &c, const double approach)
{
  if (c.strip)
    return c.free_length == 0 || c.is_open(approach) ? 0 : c.law.k;
  return c.one_sided || approach > 0 ? tangent(c.law, approach) : c.law.k;
}

double contact_energy(const Contact &c, const double approach)
{
  if (c.strip && c.free_length == 0)
    return 0;
  if (c.strip) {
    const double opens = -c.carried / c.law.k;
    return approach > opens ? 0.5 * c.law.k * approach * approach
                            : 0.5 * c.law.k * opens * opens - c.carried * (approach - opens);
  }
  return !c.one_sided && approach < 0 ? 0.5 * c.law.k * approach * approach : energy(c.law, approach);
}

Eigen::VectorXd slip_row(const Stack &stack, const Contact &c, const Eigen::Vector2d &normal)
{
  const Eigen::Vector2d along(-normal.y(), normal.x());
  Eigen::VectorXd row = Eigen::VectorXd::Zero(stack.size());
  const int a = stack.per_roll() * c.a, b = stack.per_roll() * c.b;
  // Surface of a at its contact: u_a + R_a theta_a t; of b: u_b - R_b theta_b t, t = the normal turned by 90
  // degrees.
  row.segment<2>(a) = -along;
  row.segment<2>(b) = along;
  if (stack.coupled) {
    row[a + 2] = -1;
    row[b + 2] = -1;
  }
  return row;
}

std::array<Eigen::Vector2d, 2> roller_directions(const Support &s)
{
  const auto along = [](const double angle) { return Eigen::Vector2d(std::cos(angle), std::sin(angle)); };
  return {along(s.direction + s.half_angle), along(s.direction - s.half_angle)};
}

std::array<double, 2> roller_forces(const Support &s, const Eigen::Vector2d &u)
{
  std::array<double, 2> force{};
  const double d0 = s.law.kappa * std::pow(s.preload, s.law.q);
  const auto t    = roller_directions(s);
  for (int k = 0; k < 2; ++k)
    if (const double d = t[std::size_t(k)].dot(u - s.anchor) + d0; d > 0)
      force[std::size_t(k)] = bearing_force(s.law, d);
  return force;
}

Eigen::Vector2d support_force(const Support &s, const Eigen::Vector2d &u)
{
  const Eigen::Vector2d d = u - s.anchor;
  switch (s.type) {
  case Support::Type::radial: {
    const double r = d.norm();
    return r > 0 ? Eigen::Vector2d(-bearing_force(s.law, r) / r * d) : Eigen::Vector2d(0, 0);
  }
  case Support::Type::isotropic:
    return {-s.across * d.x(), -bearing_force(s.law, d.y())};
  case Support::Type::guide: {
    const Eigen::Vector2d t(std::cos(s.direction), std::sin(s.direction));
    return -bearing_force(s.law, t.dot(d)) * t;
  }
  case Support::Type::rollers: {
    const auto t     = roller_directions(s);
    const auto force = roller_forces(s, u);
    return -force[0] * t[0] - force[1] * t[1] - s.guard * d;
  }
  }
  return {0, 0};
}

Forces forces(const Stack &stack, const Motion &u)
{
  Forces f;
  f.loads = f.contacts = f.supports = Eigen::VectorXd::Zero(stack.size());
  for (const auto *loads : {&stack.loads, &stack.side_loads})
    for (const Load &load : *loads)
      f.loads.segment<2>(stack.per_roll() * load.roll) += load.force;
  if (stack.gravity)
    for (std::size_t i = 0; i < stack.rolls.size(); ++i)
      f.loads[stack.per_roll() * int(i) + 1] -= stack.rolls[i].mass * free_fall;
  for (const Contact &c : stack.contacts) {
    const ContactState s        = contact_state(stack, c, u);
    const Eigen::Vector2d force = added_force(c, s.approach) * s.normal;
    f.contacts.segment<2>(stack.per_roll() * c.a) -= force;
    f.contacts.segment<2>(stack.per_roll() * c.b) += force;
  }
  for (const Support &s : stack.supports)
    f.supports.segment<2>(stack.per_roll() * s.roll) += support_force(s, at(u, stack, s.roll));
  f.total = f.loads + f.contacts + f.supports;
  return f;
}

Tangent tangent(const Stack &stack, const Motion &u)
{
  const int n                = stack.size();
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(n, n);
  Tangent K;
  K.total = zero;
  for (const Contact &c : stack.contacts) {
    K.contacts.push_back(zero);
    K.geometric.push_back(zero);
    add_contact(stack, c, u, K.contacts.back(), &K.geometric.back());
    K.total += K.contacts.back();
  }
  for (const Support &s : stack.supports) {
    K.supports.push_back(zero);
    const int i                         = stack.per_roll() * s.roll;
    K.supports.back().block<2, 2>(i, i) = support_tangent(s, at(u, stack, s.roll));
    K.total += K.supports.back();
  }
  return K;
}

Eigen::MatrixXd total_tangent(const Stack &stack, const Motion &u)
{
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(stack.size(), stack.size());
  for (const Contact &c : stack.contacts)
    add_contact(stack, c, u, K, nullptr);
  for (const Support &s : stack.supports) {
    const int i = stack.per_roll() * s.roll;
    K.block<2, 2>(i, i) += support_tangent(s, at(u, stack, s.roll));
  }
  return K;
}

double potential_energy(const Stack &stack, const Motion &u)
{
  double sum = 0;
  for (const Contact &c : stack.contacts)
    sum += contact_energy(c, contact_state(stack, c, u).approach);
  for (const Support &s : stack.supports)
    sum += support_energy(s, at(u, stack, s.roll));
  return sum - forces(stack, u).loads.dot(u);
}
}  // namespace mill::cluster
