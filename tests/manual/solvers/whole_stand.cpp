#include "tests/manual/solvers/whole_stand.h"
#include "core/base/errors.h"
#include "fem/body/lowest_modes.h"
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace mill::fem {
namespace {
// The stiffness of all bodies and springs, inverted by one small dense system over interface displacements, forces
// on the interfaces, rigid motions and lumps, (21.15).
class AssembledInverse {
public:
  explicit AssembledInverse(const WholeStand &stand);
  int n_unknowns() const
  {
    return n_fields + stand.n_lumps;
  }
  int n_fields      = 0;  // rows of all bodies' displacements
  int n_interface   = 0;  // coordinates of y that belong to bodies
  double force_unit = 0;  // N/m
  double mass_unit  = 0;  // kg
  std::vector<int> field_start, interface_start;

  // Displacements [bodies; lumps] under loads on [bodies; lumps] (N) and forces on the interfaces (N).
  Eigen::VectorXd solve(const Eigen::VectorXd &load, const Eigen::VectorXd &on_interface) const;
  Eigen::VectorXd coordinates(const Eigen::VectorXd &x) const;
  Eigen::VectorXd mass_times(const Eigen::VectorXd &x) const;

private:
  void check(const Eigen::MatrixXd &border) const;
  const WholeStand &stand;
  int n_rigid = 0;
  std::vector<int> rigid_start;
  std::vector<Eigen::MatrixXd> GW;  // by body, per whole body
  Eigen::PartialPivLU<Eigen::MatrixXd> lu;
};

AssembledInverse::AssembledInverse(const WholeStand &s) : stand(s)
{
  for (const StandBody &b : stand.bodies) {
    field_start.push_back(n_fields);
    interface_start.push_back(n_interface);
    rigid_start.push_back(n_rigid);
    n_fields += int(b.interface->weights.rows());
    n_interface += int(b.interface->weights.cols());
    n_rigid += int(b.part->support().rigid.cols());
    force_unit = std::max(force_unit, b.part->body().stiffness_unit());
    mass_unit += b.part->mass();
    GW.push_back(b.part->solve(b.interface->weights) / b.part->copies());
  }
  const int n_y           = n_interface + stand.n_lumps;
  Eigen::MatrixXd springs = Eigen::MatrixXd::Zero(n_y, n_y);
  for (const Connection &c : stand.connections)
    springs += c.rows.transpose() * c.stiffness.asDiagonal() * c.rows;
  springs /= force_unit;
  // Unknowns: interface displacements, interface forces / force_unit, rigid motions, lumps.
  const int forces = n_interface, rigid = 2 * n_interface, lumps = rigid + n_rigid, n = lumps + stand.n_lumps;
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < stand.bodies.size(); ++i) {
    const Eigen::MatrixXd &W = stand.bodies[i].interface->weights, &R = stand.bodies[i].part->support().rigid;
    const int q = interface_start[i], c = rigid + rigid_start[i], nq = int(W.cols()), nr = int(R.cols());
    A.block(q, forces + q, nq, nq) = -W.transpose() * GW[i] * force_unit;
    A.block(q, c, nq, nr)          = -W.transpose() * R;
    A.block(c, forces + q, nr, nq) = R.transpose() * W;
  }
  A.topLeftCorner(n_interface, n_interface).setIdentity();
  A.block(forces, 0, n_interface, n_interface) = springs.topLeftCorner(n_interface, n_interface);
  A.block(forces, forces, n_interface, n_interface).setIdentity();
  A.block(forces, lumps, n_interface, stand.n_lumps)  = springs.topRightCorner(n_interface, stand.n_lumps);
  A.block(lumps, 0, stand.n_lumps, n_interface)       = springs.bottomLeftCorner(stand.n_lumps, n_interface);
  A.block(lumps, lumps, stand.n_lumps, stand.n_lumps) = springs.bottomRightCorner(stand.n_lumps, stand.n_lumps);
  check(A);
  lu.compute(A);
}

void AssembledInverse::check(const Eigen::MatrixXd &A) const
{
  // Entries are of order one or, for soft springs, as small as 1e-6; a motion that nothing holds gives rounding.
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(A, Eigen::ComputeFullV);
  const Eigen::Index last = A.rows() - 1;
  if (svd.singularValues()[last] > 1e-12 * svd.singularValues()[0])
    return;
  const Eigen::VectorXd free = svd.matrixV().col(last).cwiseAbs();
  for (std::size_t i = 0; i < stand.bodies.size(); ++i) {
    const PartSupport &support = stand.bodies[i].part->support();
    for (std::size_t r = 0; r < support.rigid_names.size(); ++r)
      if (free[2 * n_interface + rigid_start[i] + int(r)] > 0.01 * free.maxCoeff())
        throw InputError("the springs leave the " + stand.bodies[i].part->name() + " free to move " +
                         support.rigid_names[r] + ": join it to the ground or to a part that is held");
  }
  throw InputError("the springs leave a lumped mass of the stand free: join it to a part that is held");
}

Eigen::VectorXd AssembledInverse::coordinates(const Eigen::VectorXd &x) const
{
  Eigen::VectorXd y(n_interface + stand.n_lumps);
  for (std::size_t i = 0; i < stand.bodies.size(); ++i) {
    const Eigen::MatrixXd &W                = stand.bodies[i].interface->weights;
    y.segment(interface_start[i], W.cols()) = W.transpose() * x.segment(field_start[i], W.rows());
  }
  y.tail(stand.n_lumps) = x.tail(stand.n_lumps);
  return y;
}

Eigen::VectorXd AssembledInverse::mass_times(const Eigen::VectorXd &x) const
{
  const Eigen::VectorXd lumped = stand.mass * coordinates(x);
  Eigen::VectorXd out(x.size());
  for (std::size_t i = 0; i < stand.bodies.size(); ++i) {
    const StandBody &b       = stand.bodies[i];
    const Eigen::MatrixXd &W = b.interface->weights;
    out.segment(field_start[i], W.rows()) =
        b.part->copies() * b.part->mass_times(x.segment(field_start[i], W.rows())) +
        W * lumped.segment(interface_start[i], W.cols());
  }
  out.tail(stand.n_lumps) = lumped.tail(stand.n_lumps);
  return out;
}

Eigen::VectorXd AssembledInverse::solve(const Eigen::VectorXd &load, const Eigen::VectorXd &on_interface) const
{
  const int forces = n_interface, rigid = 2 * n_interface, lumps = rigid + n_rigid;
  Eigen::VectorXd right(lumps + stand.n_lumps), x(n_unknowns());
  for (std::size_t i = 0; i < stand.bodies.size(); ++i) {
    const StandBody &b       = stand.bodies[i];
    const Eigen::MatrixXd &W = b.interface->weights, &R = b.part->support().rigid;
    const Eigen::VectorXd f                         = load.segment(field_start[i], W.rows());
    x.segment(field_start[i], W.rows())             = b.part->solve(f) / b.part->copies();
    right.segment(interface_start[i], W.cols())     = W.transpose() * x.segment(field_start[i], W.rows());
    right.segment(rigid + rigid_start[i], R.cols()) = -R.transpose() * f / force_unit;
  }
  right.segment(forces, n_interface) = on_interface / force_unit;
  right.tail(stand.n_lumps)          = load.tail(stand.n_lumps) / force_unit;
  const Eigen::VectorXd answer       = lu.solve(right);
  for (std::size_t i = 0; i < stand.bodies.size(); ++i) {
    const Eigen::MatrixXd &R = stand.bodies[i].part->support().rigid;
    x.segment(field_start[i], R.rows()) +=
        force_unit * GW[i] * answer.segment(forces + interface_start[i], GW[i].cols()) +
        R * answer.segment(rigid + rigid_start[i], R.cols());
  }
  x.tail(stand.n_lumps) = answer.tail(stand.n_lumps);
  return x;
}
}  // namespace

int n_coordinates(const WholeStand &stand)
{
  int n = stand.n_lumps;
  for (const StandBody &b : stand.bodies)
    n += int(b.interface->weights.cols());
  return n;
}

WholeModes whole_modes(const WholeStand &stand, const int n_modes)
{
  const AssembledInverse inverse(stand);
  const Eigen::VectorXd nothing = Eigen::VectorXd::Zero(inverse.n_interface);
  const SymmetricOperator T     = [&](const Eigen::VectorXd &f) -> Eigen::VectorXd {
    return inverse.force_unit * inverse.solve(f, nothing);
  };
  const SymmetricOperator M = [&](const Eigen::VectorXd &x) -> Eigen::VectorXd {
    return inverse.mass_times(x) / inverse.mass_unit;
  };
  const LowestModes modes =
      lowest_modes("modes of the assembly", T, M, inverse.n_unknowns(), inverse.n_unknowns(), n_modes);
  WholeModes out;
  out.frequency = modes.frequency / (2 * M_PI) * std::sqrt(inverse.force_unit / inverse.mass_unit);
  out.y.resize(n_coordinates(stand), n_modes);
  const Eigen::MatrixXd shapes = modes.shapes / std::sqrt(inverse.mass_unit);
  for (int k = 0; k < n_modes; ++k)
    out.y.col(k) = inverse.coordinates(shapes.col(k));
  for (std::size_t i = 0; i < stand.bodies.size(); ++i)
    out.fields.push_back(shapes.middleRows(inverse.field_start[i], stand.bodies[i].interface->weights.rows()));
  return out;
}

Eigen::MatrixXd whole_static(const WholeStand &stand, const Eigen::MatrixXd &forces)
{
  const AssembledInverse inverse(stand);
  Eigen::MatrixXd y(forces.rows(), forces.cols());
  Eigen::VectorXd load = Eigen::VectorXd::Zero(inverse.n_unknowns());
  for (Eigen::Index k = 0; k < forces.cols(); ++k) {
    load.tail(stand.n_lumps) = forces.col(k).tail(stand.n_lumps);
    y.col(k)                 = inverse.coordinates(inverse.solve(load, forces.col(k).head(inverse.n_interface)));
  }
  return y;
}
}  // namespace mill::fem
