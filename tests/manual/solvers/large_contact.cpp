#include "tests/manual/solvers/large_contact.h"
#include "core/base/errors.h"
#include "fem/body/body_pair.h"
#include "fem/contact/active_set.h"
#include <algorithm>

namespace mill::fem {
namespace {
using Eigen::VectorXd;

Surface deformed(const LargeBody &b, const VectorXd &u)
{
  Surface out = b.body->surface(b.patch);
  for (std::size_t i = 0; i < out.node.size(); ++i)
    out.points.row(Eigen::Index(i)) += u.segment<2>(2 * out.node[i]).transpose();
  return out;
}

// Normals and tangents of the deformed surface are kept, so that forces have the slave's directions on both
// bodies.
CondensedSurface condensed(const LargeBody &b, const LargeForces &state, const Surface &surface)
{
  SurfaceOptions options;
  options.tangential = true;
  return {state.tangent, 2, b.held, surface, options};
}

double out_of_balance(const LargeBody &b, const LargeForces &state, const VectorXd &external)
{
  double worst = 0;
  for (Eigen::Index i = 0; i < external.size(); ++i)
    if (!b.held[i])
      worst = std::max(worst, std::abs(state.force[i] - external[i]));
  return worst;
}

// Forces (components along x, y of the common coordinates) at surface nodes, in the body's unknowns.
VectorXd at_unknowns(const LargeBody &b, const Surface &surface, const Eigen::MatrixXd &forces)
{
  return load_on(surface, forces * b.turn, b.body->stiffness().rows()).force;
}

VectorXd load_of(const LargeBody &b)
{
  return b.load.size() > 0 ? b.load : VectorXd::Zero(b.body->stiffness().rows());
}
}  // namespace

LargeContact press_together(const LargeBody &slave, const LargeBody &master, const ElasticLaw law,
                            const double force)
{
  LargeContact out;
  out.slave  = VectorXd::Zero(slave.body->stiffness().rows());
  out.master = VectorXd::Zero(master.body->stiffness().rows());
  DrivenMode descent;
  descent.master.translation = Eigen::Vector2d(0, -1);
  descent.slave_load.force   = load_of(slave);
  descent.master_load.force  = load_of(master);
  LargeForces on_slave       = large_forces(*slave.body, slave.material, law, out.slave),
              on_master      = large_forces(*master.body, master.material, law, out.master);
  while (true) {
    const CondensedSurface first  = condensed(slave, on_slave, deformed(slave, out.slave)),
                           second = condensed(master, on_master, deformed(master, out.master));
    // Frictionless: the normal rows of the coupling that has the tangents too.
    PairOptions options;
    options.slave_load.force  = -on_slave.force;
    options.master_load.force = -on_master.force;
    VectorXd place            = master.shift;
    place[1] -= out.descent;
    const auto pair      = pair_with_friction({&first, slave.turn, slave.shift}, {&second, master.turn, place},
                                              {descent}, 0, options);
    const Eigen::Index n = pair.coupling.weight.size();
    contact::ActiveSet solver({pair.problem.C.topLeftCorner(n, n), pair.problem.G.topRows(n),
                               pair.problem.W.topRows(n), pair.problem.initial_gap.head(n)});
    const contact::State state = solver.solve({VectorXd::Constant(1, force), {}});

    // Both bodies feel each multiplier along the slave's normal at its node.
    const Eigen::MatrixXd normals =
        first.directions().topRows(Eigen::Index(first.surface().points.rows())) * slave.turn.transpose();
    Eigen::MatrixXd along(n, 2);
    for (Eigen::Index i = 0; i < n; ++i)
      along.row(i) = state.nodal[i] * normals.row(pair.coupling.node[i]);
    const VectorXd load_slave = force * load_of(slave) -
                                at_unknowns(slave, first.surface(), pair.coupling.slave.transpose() * along),
                   load_master = force * load_of(master) +
                                 at_unknowns(master, second.surface(), pair.coupling.master.transpose() * along);
    const auto step = [](const CondensedSurface &body, const VectorXd &rest) {
      return body.displacement(VectorXd::Zero(body.directions().rows()), {rest, {}});
    };
    const VectorXd d_slave  = step(first, load_slave - on_slave.force),
                   d_master = step(second, load_master - on_master.force);
    out.slave += d_slave;
    out.master += d_master;
    out.descent += state.motion[0];
    on_slave       = large_forces(*slave.body, slave.material, law, out.slave);
    on_master      = large_forces(*master.body, master.material, law, out.master);
    out.correction = std::max(d_slave.cwiseAbs().maxCoeff(), d_master.cwiseAbs().maxCoeff()) /
                     std::max(out.slave.cwiseAbs().maxCoeff(), out.master.cwiseAbs().maxCoeff());
    out.unbalanced =
        std::max(out_of_balance(slave, on_slave, load_slave), out_of_balance(master, on_master, load_master)) /
        force;
    out.residual = state.residual;
    out.nodal    = state.nodal;
    out.pressure = state.nodal.cwiseQuotient(pair.coupling.weight);
    out.points   = pair.coupling.mean * pair.coupling.points;
    ++out.iterations;
    if (out.correction < 1e-10)
      return out;
    if (out.iterations == 40)
      throw SolverError({"large displacements: no equilibrium after 40 Newton steps", "", "", "", "press less"});
  }
}
}  // namespace mill::fem
