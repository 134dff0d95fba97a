#include "dynamics/chatter/equations.h"
#include "core/base/errors.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::dynamics {
namespace {
using Eigen::Map;
using Eigen::VectorXd;
using ConstVector = Map<const VectorXd>;

constexpr double smallest_gap = 0.02;  // of the steady one: rolls that come closer count as touching

// Force of a contact, N, below zero where it would have to pull.
double pressing(const RollContact &c, const ConstVector &x)
{
  return c.preload + c.stiffness * c.row.dot(x);
}
}  // namespace

ChatterEquations::ChatterEquations(const ChatterStandModel &stand, const WorkingPoint &point,
                                   const Linearisation scheme, const ChatterRunOptions &options)
    : structure(stand.structure), contacts(options.contacts),
      roll_bite(bite::unsteady_bite(point.bite, point.state, scheme)),
      steady_moment(bite::steady_moment(roll_bite)), steady(bite::bite_at(roll_bite, steady_moment)),
      steady_by_(bite::bite_slopes_at(roll_bite, steady_moment).by),
      entry_(stand.strip_modulus / stand.entry_distance), exit_(stand.strip_modulus / stand.exit_distance),
      impedance_(std::sqrt(stand.strip_modulus * options.strip_density))
{
  const Eigen::Index n = structure.n();
  if (!(options.strip_density > 0))
    throw InputError(
        fmt::format("a strip of density {} kg/m3 cannot move; steel has 7850", options.strip_density));
  const Eigen::LDLT<Eigen::MatrixXd> mass(structure.M);
  K_ = mass.solve(structure.K);
  C_ = mass.solve(structure.C);
  b_ = mass.solve(structure.b);
  contact_row_.resize(n, Eigen::Index(contacts.size()));
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].row.size() != n)
      throw InputError(fmt::format("contact \"{}\" is a row of {} numbers, the stand has {} unknowns",
                                   contacts[i].name, contacts[i].row.size(), n));
    contact_row_.col(Eigen::Index(i)) = mass.solve(contacts[i].row);
  }
}

Eigen::Index ChatterEquations::size() const
{
  return 2 * structure.n() + 2;
}

VectorXd ChatterEquations::magnitude() const
{
  const Eigen::Index n = structure.n();
  const auto &by       = steady_by_;
  const double reach   = displaced_rolls(structure, 0.5).cwiseAbs().maxCoeff();
  const double fast    = std::sqrt(std::abs(by.force[0]) * structure.b.dot(b_));  // rad/s, mass on the strip
  VectorXd m(size());
  m.head(n).setConstant(reach);
  m.segment(n, n).setConstant(reach * fast);
  m[2 * n]     = entry_ * (std::abs(by.entry_speed[0]) / fast + std::abs(by.entry_speed[1]));
  m[2 * n + 1] = exit_ * (std::abs(by.exit_speed[0]) / fast + std::abs(by.exit_speed[1]));
  return m;
}

bite::Moment ChatterEquations::moment(const double *z) const
{
  const Eigen::Index n = structure.n();
  const ConstVector x(z, n), v(z + n, n);
  return {steady_moment[0] + structure.b.dot(x), steady_moment[1] + structure.b.dot(v),
          std::max(0., steady_moment[2] + z[2 * n]), std::max(0., steady_moment[3] + z[2 * n + 1]),
          steady_moment[4]};
}

// Both spans are bars whose far ends keep their speeds; where they meet a wave runs into each of them, (26.6).
double ChatterEquations::free_speed(const bite::Moment &m) const
{
  const double entry = steady_moment[4], exit = steady_moment[0];  // thickness of the spans
  return (entry * steady.entry_speed + exit * steady.exit_speed + (exit * m[3] - entry * m[2]) / impedance_) /
         (entry + exit);
}

bite::BiteAnswer ChatterEquations::answer(const double *z)
{
  const bite::Moment m = moment(z);
  ++bites;
  bite::BiteAnswer a = bite::bite_at(roll_bite, m);
  if (!strip_held) {
    a             = {};
    a.contact     = false;
    a.entry_speed = a.exit_speed = free_speed(m);
  }
  return a;
}

void ChatterEquations::slope(const double *z, double *derivative)
{
  const Eigen::Index n = structure.n();
  const ConstVector x(z, n), v(z + n, n);
  const bite::BiteAnswer a = answer(z);
  Map<VectorXd> d(derivative, size());
  d.head(n)                 = v;
  d.segment(n, n).noalias() = b_ * (a.force - steady.force) - K_ * x - C_ * v;
  for (std::size_t i = 0; i < contacts.size(); ++i)  // the pull that the spring in K has and a contact has not
    d.segment(n, n) += contact_row_.col(Eigen::Index(i)) * std::min(0., pressing(contacts[i], x));
  d[2 * n]     = entry_ * (a.entry_speed - steady.entry_speed);
  d[2 * n + 1] = -exit_ * (a.exit_speed - steady.exit_speed);
}

void ChatterEquations::jacobian(const double *z, Eigen::Ref<Eigen::MatrixXd> J)
{
  const Eigen::Index n = structure.n();
  const ConstVector x(z, n);
  const bite::Moment m = moment(z);
  ++bites;
  bite::LinearCoefficients by{};
  if (strip_held)
    by = bite::bite_slopes_at(roll_bite, m).by;
  else {
    const double whole = (steady_moment[4] + steady_moment[0]) * impedance_;
    by.entry_speed[2] = by.exit_speed[2] = -steady_moment[4] / whole;
    by.entry_speed[3] = by.exit_speed[3] = steady_moment[0] / whole;
  }
  for (int side = 0; side < 2; ++side)
    if (steady_moment[2 + side] + z[2 * n + side] < 0)  // slack: no pull that could change
      by.entry_speed[2 + side] = by.exit_speed[2 + side] = by.force[2 + side] = 0;

  const Eigen::RowVectorXd gap = structure.b.transpose();
  J.setZero();
  J.block(0, n, n, n).setIdentity();
  J.block(n, 0, n, n).noalias() = by.force[0] * b_ * gap - K_;
  J.block(n, n, n, n).noalias() = by.force[1] * b_ * gap - C_;
  J.block(n, 2 * n, n, 1)       = by.force[2] * b_;
  J.block(n, 2 * n + 1, n, 1)   = by.force[3] * b_;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (pressing(contacts[i], x) < 0)
      J.block(n, 0, n, n) +=
          contacts[i].stiffness * contact_row_.col(Eigen::Index(i)) * contacts[i].row.transpose();
  const auto tension_row = [&](const Eigen::Index row, const double per_length, const bite::StripRow &speed) {
    J.row(row) << per_length * speed[0] * gap, per_length * speed[1] * gap, per_length * speed[2],
        per_length * speed[3];
  };
  tension_row(2 * n, entry_, by.entry_speed);
  tension_row(2 * n + 1, -exit_, by.exit_speed);
}

Eigen::Index ChatterEquations::edges() const
{
  return n_edges + Eigen::Index(contacts.size());
}

void ChatterEquations::edge_values(const double *z, double *value)
{
  const Eigen::Index n = structure.n();
  const ConstVector x(z, n);
  const bite::Moment m = moment(z);
  const auto whole = bite::yield_reserve(roll_bite, m), neutral = bite::neutral_reserve(roll_bite, m);
  value[entry_tight] = 1e-9 * (steady_moment[2] + z[2 * n]);
  value[exit_tight]  = 1e-9 * (steady_moment[3] + z[2 * n + 1]);
  value[held]        = bite::contact_reserve(roll_bite, m) / steady_moment[4];
  value[from_exit]   = strip_held ? neutral[0] : 1;
  value[from_entry]  = strip_held ? neutral[1] : 1;
  value[entry_whole] = whole[0];
  value[exit_whole]  = whole[1];
  value[gap_open]    = m[0] / steady_moment[0] - smallest_gap;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    value[n_edges + Eigen::Index(i)] = pressing(contacts[i], x) / steady.force;
}
}  // namespace mill::dynamics
