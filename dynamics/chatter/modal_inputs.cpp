#include "dynamics/chatter/modal_inputs.h"
#include <Eigen/Eigenvalues>
#include <cmath>

namespace mill::dynamics {
Eigen::MatrixXd damping_by(const Eigen::VectorXd &frequency, const double damping, const ModalChange &change)
{
  const Eigen::VectorXd w = 2 * M_PI * frequency;
  const Eigen::Index n    = w.size();
  Eigen::MatrixXd C       = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      if (!(w[i] + w[j] > 0))
        continue;
      const double dK = change.dK.size() ? change.dK(i, j) : 0, dM = change.dM.size() ? change.dM(i, j) : 0;
      C(i, j) = 2 * damping * (dK + w[i] * w[j] * dM) / (w[i] + w[j]);
    }
  return C;
}

StandStructure moved_structure(const StandStructure &stand, const double damping, const ModalChange &change)
{
  StandStructure moved = stand;
  if (change.dK.size())
    moved.K += change.dK;
  if (change.dM.size())
    moved.M += change.dM;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(moved.K, moved.M);
  const Eigen::MatrixXd MV = moved.M * solver.eigenvectors();
  const Eigen::VectorXd w  = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  moved.C                  = MV * (2 * damping * w).asDiagonal() * MV.transpose();
  return moved;
}
}  // namespace mill::dynamics
