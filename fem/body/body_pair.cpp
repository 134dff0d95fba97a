#include "fem/body/body_pair.h"
#include "core/base/errors.h"
#include <Eigen/Geometry>

namespace mill::fem {
namespace {
using Sparse = contact::Coupling::Sparse;

Eigen::MatrixXd turn_of(const PlacedBody &p)
{
  const Eigen::Index d = p.body->surface().points.cols();
  return p.turn.size() > 0 ? p.turn : Eigen::MatrixXd::Identity(d, d);
}

Surface surface_of(const PlacedBody &p)
{
  const Eigen::Index d = p.body->surface().points.cols();
  return contact::placed(p.body->surface(), turn_of(p), p.shift.size() > 0 ? p.shift : Eigen::VectorXd::Zero(d));
}

// The first n kept unknowns are the normals.
Eigen::MatrixXd normals_of(const PlacedBody &p)
{
  return p.body->directions().topRows(p.body->surface().points.rows()) * turn_of(p).transpose();
}

Eigen::MatrixXd normal_flexibility(const PlacedBody &p)
{
  const Eigen::Index n = p.body->surface().points.rows();
  return p.flexibility * p.body->flexibility().topLeftCorner(n, n);
}

// Displacement of the kept unknowns under a load case.
Eigen::VectorXd whole_response(const PlacedBody &p, const LoadCase &load)
{
  if (load.force.size() == 0 && load.displacement.size() == 0)
    return Eigen::VectorXd::Zero(p.body->directions().rows());
  // Imposed displacements do not depend on the modulus.
  Eigen::VectorXd out = p.flexibility * p.body->response({load.force, {}});
  if (load.displacement.size() > 0)
    out += p.body->response({{}, load.displacement});
  return out;
}

// Of the outward normal displacements among them, which come first.
Eigen::VectorXd response(const PlacedBody &p, const LoadCase &load)
{
  return whole_response(p, load).head(p.body->surface().points.rows());
}

// Displacement of each point by a unit of a rigid motion, (n, d).
Eigen::MatrixXd moved(const Eigen::MatrixXd &points, const RigidMotion &m)
{
  const Eigen::Index d = points.cols();
  Eigen::MatrixXd out  = Eigen::MatrixXd::Zero(points.rows(), d);
  if (m.translation.size() > 0)
    out.rowwise() += m.translation.transpose();
  if (m.rotation.size() > 0) {
    Eigen::MatrixXd from = points;
    if (m.about.size() > 0)
      from.rowwise() -= m.about.transpose();
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      if (d == 2)
        out.row(i) += m.rotation[0] * Eigen::RowVector2d(-from(i, 1), from(i, 0));
      else
        out.row(i) += Eigen::Vector3d(m.rotation).cross(Eigen::Vector3d(from.row(i))).transpose();
    }
  }
  return out;
}

// Outward normal displacement of the surface nodes by a rigid motion.
Eigen::VectorXd along_normals(const Eigen::MatrixXd &points, const Eigen::MatrixXd &normals, const RigidMotion &m)
{
  return moved(points, m).cwiseProduct(normals).rowwise().sum();
}

Eigen::VectorXd gap_at_points(const contact::Coupling &c, const PairOptions &options)
{
  if (!options.gap)
    return c.gap;
  Eigen::VectorXd out(c.points.rows());
  for (Eigen::Index q = 0; q < out.size(); ++q)
    out[q] = options.gap(c.points.row(q));
  return out;
}

// Rows: components of a multiplier (all normals, then tangents); columns: kept unknowns of one body.  Part of the
// mean displacement of the body's nodes along the multiplier's directions.
Sparse component_rows(const Sparse &mean, const Eigen::MatrixXd &of_multiplier, const Eigen::MatrixXd &of_body)
{
  const Eigen::Index n = mean.rows(), m = mean.cols(), d = of_body.cols();
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index row = 0; row < n; ++row)
    for (Sparse::InnerIterator it(mean, row); it; ++it)
      for (Eigen::Index k = 0; k < d; ++k)
        for (Eigen::Index l = 0; l < d; ++l)
          if (const double part = of_multiplier.row(k * n + row).dot(of_body.row(l * m + it.col())); part != 0)
            entries.emplace_back(int(k * n + row), int(l * m + it.col()), part * it.value());
  Sparse out(d * n, d * m);
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

// Mean of a vector given at nodes, along the directions of the multipliers.
Eigen::VectorXd components(const Sparse &mean, const Eigen::MatrixXd &of_multiplier,
                           const Eigen::MatrixXd &at_nodes)
{
  const Eigen::MatrixXd vectors = mean * at_nodes;
  return vectors.replicate(at_nodes.cols(), 1).cwiseProduct(of_multiplier).rowwise().sum();
}

Eigen::MatrixXd contracted(const Sparse &rows, const Eigen::MatrixXd &C)
{
  const Eigen::MatrixXd half = rows * C;
  return rows * half.transpose();
}
}  // namespace

Eigen::VectorXd BodyPair::pressure(const Eigen::VectorXd &nodal) const
{
  return nodal.cwiseQuotient(coupling.weight);
}
Eigen::VectorXd BodyPair::slave_forces(const Eigen::VectorXd &nodal) const
{
  return -(coupling.slave.transpose() * nodal);
}
Eigen::VectorXd BodyPair::master_forces(const Eigen::VectorXd &nodal) const
{
  return -(coupling.master.transpose() * nodal);
}
Eigen::MatrixXd BodyPair::points() const
{
  return coupling.mean * coupling.points;
}

BodyPair pair_bodies(const PlacedBody &slave, const PlacedBody &master, const std::vector<DrivenMode> &modes,
                     const PairOptions &options)
{
  const Surface on_slave = surface_of(slave), on_master = surface_of(master);
  if (on_slave.points.cols() != on_master.points.cols() || on_slave.axisymmetric != on_master.axisymmetric)
    throw InputError("the two bodies of a contact are not of the same kind: plane, of revolution, or in space");
  BodyPair out;
  out.coupling  = contact::couple(on_slave, on_master, {options.reach});
  const auto &S = out.coupling.slave, &T = out.coupling.master;
  contact::Problem &p = out.problem;
  p.C                 = contracted(S, normal_flexibility(slave)) + contracted(T, normal_flexibility(master));
  p.C                 = (0.5 * (p.C + p.C.transpose())).eval();
  p.initial_gap       = out.coupling.mean * gap_at_points(out.coupling, options) -
                  S * response(slave, options.slave_load) - T * response(master, options.master_load);
  p.G.resize(S.rows(), Eigen::Index(modes.size()));
  p.W.resize(S.rows(), Eigen::Index(modes.size()));
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const DrivenMode &m = modes[k];
    p.G.col(Eigen::Index(k)) =
        S * (along_normals(on_slave.points, normals_of(slave), m.slave) + response(slave, m.slave_push)) +
        T * (along_normals(on_master.points, normals_of(master), m.master) + response(master, m.master_push));
    p.W.col(Eigen::Index(k)) = -(S * response(slave, m.slave_load)) - T * response(master, m.master_load);
  }
  return out;
}

BodyPair pair_with_rigid(const PlacedBody &slave, const std::vector<DrivenMode> &modes, const PairOptions &options)
{
  const Surface on_slave = surface_of(slave);
  BodyPair out;
  out.coupling        = contact::couple_to_rigid(on_slave);
  const auto &S       = out.coupling.slave;
  contact::Problem &p = out.problem;
  p.C                 = contracted(S, normal_flexibility(slave));
  p.C                 = (0.5 * (p.C + p.C.transpose())).eval();
  p.initial_gap =
      out.coupling.mean * gap_at_points(out.coupling, options) - S * response(slave, options.slave_load);
  p.G.resize(S.rows(), Eigen::Index(modes.size()));
  p.W.resize(S.rows(), Eigen::Index(modes.size()));
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const DrivenMode &m = modes[k];
    p.G.col(Eigen::Index(k)) =
        S * (along_normals(on_slave.points, normals_of(slave), m.slave) + response(slave, m.slave_push)) -
        S * along_normals(on_slave.points, normals_of(slave), m.master);
    p.W.col(Eigen::Index(k)) = -(S * response(slave, m.slave_load));
  }
  return out;
}

FrictionalBodies pair_with_friction(const PlacedBody &slave, const PlacedBody &master,
                                    const std::vector<DrivenMode> &modes, const double friction,
                                    const PairOptions &options)
{
  const Surface on_slave = surface_of(slave), on_master = surface_of(master);
  const Eigen::Index d = on_slave.points.cols();
  if (on_master.points.cols() != d || on_slave.axisymmetric != on_master.axisymmetric)
    throw InputError("the two bodies of a contact are not of the same kind: plane, of revolution, or in space");
  if (slave.body->directions().rows() != d * on_slave.points.rows() ||
      master.body->directions().rows() != d * on_master.points.rows())
    throw InputError("friction needs both bodies condensed with their tangential displacements");
  FrictionalBodies out;
  out.coupling  = contact::couple(on_slave, on_master, {options.reach});
  const auto &S = out.coupling.slave, &T = out.coupling.master;
  const Eigen::Index n = S.rows(), n_slave = on_slave.points.rows();
  const Eigen::MatrixXd directions = slave.body->directions() * turn_of(slave).transpose(),
                        others     = master.body->directions() * turn_of(master).transpose();
  Eigen::MatrixXd frame(d * n, d);  // of the multipliers: that of their slave node
  for (Eigen::Index k = 0; k < d; ++k)
    for (Eigen::Index i = 0; i < n; ++i)
      frame.row(k * n + i) = directions.row(k * n_slave + out.coupling.node[i]);
  // opening = gap - frame . (mean of the slave's displacement - mean of the master's)
  const Sparse B = component_rows(S, frame, directions), D = component_rows(T, frame, others);
  contact::FrictionProblem &p = out.problem;
  p.C                         = contracted(B, slave.flexibility * slave.body->flexibility()) +
        contracted(D, master.flexibility * master.body->flexibility());
  p.C                 = (0.5 * (p.C + p.C.transpose())).eval();
  const double spring = p.C.diagonal().mean();
  for (Eigen::Index i = n; i < d * n; ++i)
    if (frame.row(i).squaredNorm() == 0)
      p.C(i, i) = spring;
  // What loads open beforehand is not slip: tangential openings are measured from that state.
  const Eigen::VectorXd loaded =
      D * whole_response(master, options.master_load) - B * whole_response(slave, options.slave_load);
  p.initial_gap = out.coupling.mean * gap_at_points(out.coupling, options) + loaded.head(n);
  p.mu          = Eigen::VectorXd::Constant(n, friction);
  p.G.resize(d * n, Eigen::Index(modes.size()));
  p.W.resize(d * n, Eigen::Index(modes.size()));
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const DrivenMode &m      = modes[k];
    p.G.col(Eigen::Index(k)) = components(S, frame, moved(on_slave.points, m.slave)) -
                               components(T, frame, moved(on_master.points, m.master)) +
                               B * whole_response(slave, m.slave_push) - D * whole_response(master, m.master_push);
    p.W.col(Eigen::Index(k)) = D * whole_response(master, m.master_load) - B * whole_response(slave, m.slave_load);
  }
  return out;
}
}  // namespace mill::fem
