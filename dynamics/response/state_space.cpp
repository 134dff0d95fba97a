#include "dynamics/response/state_space.h"
#include "core/base/errors.h"
#include "dynamics/response/modes.h"
#include <Eigen/LU>
#include <cmath>

namespace mill::dynamics {
StateSpace state_space(const MillModel &model)
{
  const Eigen::Index n      = model.M.size();
  const Modes undamped      = modes(model);
  const Eigen::MatrixXd &V  = undamped.shape;
  const Eigen::VectorXd rad = 2 * M_PI * undamped.frequency;
  const double unit         = rad.maxCoeff() > 0 ? rad.maxCoeff() : 1;
  // A free mode has no frequency to be scaled with; any positive number keeps the equations right.
  const Eigen::VectorXd scale  = (rad.array() > 1e-7 * unit).select(rad, unit);
  const Eigen::MatrixXd D      = V.transpose() * model.C * V;
  const Eigen::VectorXd force  = V.transpose() * model.b;
  const Eigen::VectorXd spring = rad.cwiseAbs2().cwiseQuotient(scale);

  StateSpace system;
  system.A                         = Eigen::MatrixXd::Zero(2 * n, 2 * n);  // (7.1)
  system.A.topRightCorner(n, n)    = scale.asDiagonal();
  system.A.bottomLeftCorner(n, n)  = (-spring).asDiagonal();
  system.A.bottomRightCorner(n, n) = -D;
  system.B                         = Eigen::VectorXd::Zero(2 * n);
  system.B.tail(n)                 = force;
  system.C                         = Eigen::MatrixXd::Zero(n + 1, 2 * n);
  system.C.topRows(n)              = V * system.A.bottomRows(n);  // y'' = V q''
  system.C.row(n).head(n)          = model.load_cell.transpose() * V * scale.cwiseInverse().asDiagonal();
  system.D                         = Eigen::VectorXd::Zero(n + 1);
  system.D.head(n)                 = model.b.cwiseQuotient(model.M);
  return system;
}

Eigen::VectorXd equilibrium(const StateSpace &system, const double force)
{
  const Eigen::FullPivLU<Eigen::MatrixXd> factor(system.A);
  if (!factor.isInvertible())
    throw SolverError({"no static equilibrium of the lumped model under a constant force",
                       "the state matrix is singular", "a part of the lumped model is not held to the ground",
                       "give K1, K2, K3, K5, K6 and K7 values above zero", ""});
  return factor.solve(-system.B * force);
}
}  // namespace mill::dynamics
