#include "tests/manual/solvers/plastic_solid.h"
#include "core/base/errors.h"
#include "fem/body/condensed_surface.h"
#include "fem/contact/active_set.h"
#include <algorithm>
#include <cmath>

namespace mill::fem {
namespace {
using Eigen::VectorXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct Forces {
  VectorXd force;
  SymmetricSparse tangent;
  double energy  = 0;
  double plastic = 0;  // share of points
};

// @param whole  with force and tangent, otherwise the energy alone
Forces forces(const PressedSolid &solid, const VectorXd &u, const bool whole)
{
  Forces out;
  if (whole) {
    out.force   = VectorXd::Zero(u.size());
    out.tangent = solid.body->stiffness();
    Eigen::Map<Eigen::ArrayXd>(out.tangent.valuePtr(), out.tangent.nonZeros()).setZero();
  }
  Eigen::MatrixXd B, DB, K;
  VectorXd local, f;
  double n_points     = 0;
  const double two_mu = solid.law.youngs_modulus / (1 + solid.law.poisson_ratio);
  solid.body->each_cell([&](const std::vector<int> &nodes, const std::vector<SolidPoint> &points) {
    const auto n = Eigen::Index(nodes.size());
    local.resize(3 * n);
    for (Eigen::Index a = 0; a < n; ++a)
      local.segment<3>(3 * a) = u.segment<3>(3 * nodes[a]);
    B.setZero(6, 3 * n);
    K.setZero(3 * n, 3 * n);
    f.setZero(3 * n);
    for (const SolidPoint &point : points) {
      for (Eigen::Index a = 0; a < n; ++a) {
        const double x = point.gradient(0, a), y = point.gradient(1, a), z = point.gradient(2, a);
        B.col(3 * a) << x, 0, 0, y, 0, z;
        B.col(3 * a + 1) << 0, y, 0, x, z, 0;
        B.col(3 * a + 2) << 0, 0, z, 0, y, x;
      }
      const Vector6 strain  = B * local;
      const PlasticStress s = plastic_stress(solid.law, strain);
      out.energy += point.weight * s.energy;
      const double mean = strain.head<3>().sum() / 3;
      const double norm =
          std::sqrt((strain.head<3>().array() - mean).square().sum() + 0.5 * strain.tail<3>().squaredNorm());
      out.plastic += two_mu * norm > solid.law.yield;
      ++n_points;
      if (!whole)
        continue;
      f += point.weight * (B.transpose() * s.stress);
      DB.noalias() = point.weight * s.tangent * B;
      K.noalias() += B.transpose() * DB;
    }
    if (!whole)
      return;
    for (Eigen::Index j = 0; j < 3 * n; ++j) {
      const int column = 3 * nodes[j / 3] + int(j % 3);
      out.force[column] += f[j];
      for (Eigen::Index i = 0; i < 3 * n; ++i)
        if (const int row = 3 * nodes[i / 3] + int(i % 3); row <= column)
          out.tangent.coeffRef(row, column) += K(i, j);
    }
  });
  out.plastic /= n_points;
  return out;
}

// Largest force on a free unknown that the contact does not explain.
double out_of_balance(const PressedSolid &solid, const Forces &state, const VectorXd &pressing)
{
  double worst = 0;
  for (Eigen::Index i = 0; i < pressing.size(); ++i)
    if (!solid.held[i])
      worst = std::max(worst, std::abs(state.force[i] - pressing[i]));
  return worst;
}
}  // namespace

PlasticStress plastic_stress(const PlasticLaw &law, const Vector6 &strain)
{
  const double mu    = law.youngs_modulus / (2 * (1 + law.poisson_ratio)),
               kappa = law.youngs_modulus / (3 * (1 - 2 * law.poisson_ratio)), volume = strain.head<3>().sum();
  Vector6 deviator = strain;  // as a tensor: shears halved
  deviator.head<3>().array() -= volume / 3;
  deviator.tail<3>() *= 0.5;
  const double norm = std::sqrt(deviator.head<3>().squaredNorm() + 2 * deviator.tail<3>().squaredNorm()),
               s    = 2 * mu * norm;
  const bool flows  = s > law.yield;
  const double rest = flows ? (1 - law.hardening) * law.yield / s : 0, share = flows ? law.hardening + rest : 1;
  PlasticStress out;
  out.stress = 2 * mu * share * deviator;
  out.stress.head<3>().array() += kappa * volume;
  out.tangent.setZero();
  out.tangent.topLeftCorner<3, 3>().setConstant(kappa - 2 * mu * share / 3);
  out.tangent.diagonal().head<3>().array() += 2 * mu * share;
  out.tangent.diagonal().tail<3>().setConstant(mu * share);
  if (flows)  // d(1/s) turns the law's second part into a projection across the deviator
    out.tangent -= 2 * mu * rest / (norm * norm) * deviator * deviator.transpose();
  const double elastic = std::min(s, law.yield);
  out.energy           = 0.5 * kappa * volume * volume + elastic * elastic / (4 * mu);
  if (flows)
    out.energy += (0.5 * law.hardening * (s * s - law.yield * law.yield) +
                   (1 - law.hardening) * law.yield * (s - law.yield)) /
                  (2 * mu);
  return out;
}

PressedState press_plastic(const PressedSolid &solid)
{
  if (!(solid.law.hardening > 0) || !(solid.law.yield > 0))
    throw InputError("plastic solid: yield stress and hardening must be positive");
  const Eigen::Index n_all = 3 * solid.body->nodes().rows();
  if (Eigen::Index(solid.held.size()) != n_all)
    throw InputError("plastic solid: held unknowns are not of this body");
  const Surface patch = solid.body->surface(solid.patch);
  const auto n        = Eigen::Index(patch.node.size());
  VectorXd gap(n);
  for (Eigen::Index i = 0; i < n; ++i)
    gap[i] = solid.gap(patch.points.row(i).transpose());
  SurfaceOptions along;
  along.direction = solid.direction;
  PressedState out;
  out.displacement = VectorXd::Zero(n_all);
  Forces now       = forces(solid, out.displacement, true);
  for (out.iterations = 1; out.iterations <= 60; ++out.iterations) {
    const CondensedSurface body(now.tangent, 3, solid.held, patch, along);
    out.n_unknowns = body.n_unknowns();
    // In total displacements: K u' = K u - force(u) + contact.
    LoadCase rest;
    rest.force = now.tangent.selfadjointView<Eigen::Upper>() * out.displacement - now.force;
    contact::ActiveSet solver({body.flexibility(), Eigen::MatrixXd::Ones(n, 1), {}, gap - body.response(rest)});
    const contact::State state = solver.solve({VectorXd::Zero(1), {1}});
    const VectorXd step        = body.displacement(-state.nodal, rest) - out.displacement;
    VectorXd pressing          = VectorXd::Zero(n_all);
    for (Eigen::Index i = 0; i < n; ++i)
      pressing.segment<3>(3 * patch.node[i]) -= state.nodal[i] * body.directions().row(i).transpose();
    // The first step makes the displacements admissible and is taken whole.
    double length = 1;
    if (out.iterations > 1)
      for (int k = 0; k < 10; ++k) {
        const double slope = (now.force).dot(step);
        const Forces then  = forces(solid, out.displacement + length * step, false);
        // Close to the end the energy is not a criterion: rounding of a sum is not a rise.
        if (then.energy <= now.energy + 1e-4 * length * slope + 1e-12 * std::abs(now.energy))
          break;
        length *= 0.5;
      }
    out.displacement += length * step;
    now            = forces(solid, out.displacement, true);
    out.force      = state.resultant[0];
    out.nodal      = state.nodal;
    out.n_touching = int(std::count(state.active.begin(), state.active.end(), 1));
    out.residual   = state.residual;
    out.plastic    = now.plastic;
    out.unbalanced = out_of_balance(solid, now, pressing) / out.force;
    if (length == 1 && out.unbalanced < 1e-10)
      return out;
  }
  throw SolverError(
      {"plastic solid: no equilibrium after 60 Newton steps", "", "", "a finer mesh, or more hardening", ""});
}
}  // namespace mill::fem
