#include "dynamics/chatter/modal_inputs.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mill::dynamics {
namespace {
double entry(const Eigen::MatrixXd &matrix, const Eigen::Index i, const Eigen::Index j)
{
  return matrix.size() ? matrix(i, j) : 0;
}

// (27.16): D = diag(loss_kk / w_k) in modes that turn with the change.
Eigen::MatrixXd loss_by(const Eigen::VectorXd &w, const Eigen::MatrixXd &loss, const ModalChange &change)
{
  constexpr double one_frequency = 1e-12;  // -, of squares: rounding of the eigenvalues
  const Eigen::Index n           = w.size();
  const auto D                   = [&](const Eigen::Index k) { return w[k] > 0 ? loss(k, k) / w[k] : 0; };
  Eigen::MatrixXd C              = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double root = w[j] * w[j];
    double dL         = entry(change.dL, j, j) - entry(change.dM, j, j) * loss(j, j);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double other = w[i] * w[i], dK = entry(change.dK, i, j), dM = entry(change.dM, i, j);
      if (i == j || std::abs(root - other) <= one_frequency * std::max(root, other))
        continue;
      dL += 2 * loss(j, i) * (dK - root * dM) / (root - other);
      C(i, j) = (dK * (D(j) - D(i)) - dM * (root * D(j) - other * D(i))) / (root - other) + dM * (D(i) + D(j));
    }
    if (w[j] > 0)
      C(j, j) = entry(change.dM, j, j) * D(j) + dL / w[j] -
                0.5 * D(j) * (entry(change.dK, j, j) - root * entry(change.dM, j, j)) / root;
  }
  return C;
}
}  // namespace

Eigen::MatrixXd damping_by(const Eigen::VectorXd &frequency, const DampingOfModes &damping,
                           const ModalChange &change)
{
  const Eigen::VectorXd w = 2 * M_PI * frequency;
  const Eigen::Index n    = w.size();
  Eigen::MatrixXd C       = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j)
      if (w[i] + w[j] > 0)
        C(i, j) =
            2 * damping.ratio * (entry(change.dK, i, j) + w[i] * w[j] * entry(change.dM, i, j)) / (w[i] + w[j]);
  if (damping.loss.size())
    C += loss_by(w, damping.loss, change);
  return C;
}

Eigen::MatrixXd damping_matrix(const Eigen::MatrixXd &K, const Eigen::MatrixXd &M, const DampingOfModes &damping)
{
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, M);
  const Eigen::MatrixXd &V = solver.eigenvectors();
  const Eigen::VectorXd w  = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  Eigen::VectorXd D        = 2 * damping.ratio * w;
  if (damping.loss.size())
    for (Eigen::Index k = 0; k < w.size(); ++k)
      if (w[k] > 0)
        D[k] += V.col(k).dot(damping.loss * V.col(k)) / w[k];
  const Eigen::MatrixXd MV = M * V;
  return MV * D.asDiagonal() * MV.transpose();
}

StandStructure moved_structure(const StandStructure &stand, const DampingOfModes &before,
                               const DampingOfModes &after, const ModalChange &change)
{
  StandStructure moved = stand;
  if (change.dK.size())
    moved.K += change.dK;
  if (change.dM.size())
    moved.M += change.dM;
  moved.C += damping_matrix(moved.K, moved.M, after) - damping_matrix(stand.K, stand.M, before);
  return moved;
}
}  // namespace mill::dynamics
