#include "fem/roll/frictional_pair.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace mill::fem {
FrictionPoint load_with_friction(const ContactPair &pair, const CondensedRoll &first, const CondensedRoll &second,
                                 const double friction, const double load, const int steps)
{
  const Eigen::MatrixXd &A = first.symmetric.traction, &B = second.symmetric.traction;
  if (A.size() == 0 || B.size() != A.size() || pair.grid.whole)
    throw std::logic_error("friction needs both rolls condensed with tractions, and a quarter of the contact");
  const Eigen::Index n = A.rows() / 3;
  // The second roll carries the opposite tangential force, and its displacement is subtracted from the first
  // one's.
  contact::FrictionProblem problem;
  problem.C                            = A + B;
  problem.C.topRightCorner(n, 2 * n)   = A.topRightCorner(n, 2 * n) - B.topRightCorner(n, 2 * n);
  problem.C.bottomLeftCorner(2 * n, n) = problem.C.topRightCorner(n, 2 * n).transpose();
  // A node on a plane of symmetry cannot move across it: a spring of its own keeps the matrix definite.
  const double spring = problem.C.diagonal().mean();
  for (Eigen::Index i = n; i < 3 * n; ++i)
    if (problem.C(i, i) == 0)
      problem.C(i, i) = spring;
  problem.G                = Eigen::MatrixXd::Zero(3 * n, 1);
  problem.G.col(0).head(n) = Eigen::VectorXd::Ones(n);
  problem.initial_gap      = pair.problem.initial_gap;
  problem.mu               = Eigen::VectorXd::Constant(n, friction);
  contact::FrictionSolver solver(std::move(problem));
  const double force = load / pair.multiplicity;
  for (int step = 1; step <= steps; ++step)
    solver.advance({Eigen::VectorXd::Constant(1, force * step / steps), {}});
  const contact::FrictionState &s = solver.state();
  FrictionPoint point{load, s.motion[0], pair.multiplicity * s.stiffness(0, 0), 0, 0, s.residual};
  int touching = 0, slipping = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    if (s.status[std::size_t(i)] == contact::Status::open)
      continue;
    ++touching;
    slipping += s.status[std::size_t(i)] == contact::Status::slip;
    if (friction > 0)
      point.traction =
          std::max(point.traction, std::hypot(s.nodal[n + i], s.nodal[2 * n + i]) / (friction * s.nodal[i]));
  }
  point.slipping = touching > 0 ? double(slipping) / touching : 0;
  return point;
}

FrictionEffect friction_effect(const ContactPair &pair, const CondensedRoll &first, const CondensedRoll &second,
                               const double friction, const double load, const int steps)
{
  const FrictionPoint with = load_with_friction(pair, first, second, friction, load, steps);
  return {with.tangent / solve_load(pair, load).tangent, with.slipping};
}
}  // namespace mill::fem
