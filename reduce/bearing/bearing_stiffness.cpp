#include "reduce/bearing/bearing_stiffness.h"
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>
#include <utility>
#include <vector>

namespace mill::bearing {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
using Roots = std::vector<std::pair<Index, VectorXd>>;  // roller, column of L in its modes

// Each roller's slope as L L^T with its rank: a roller on one slice has rank one, an unloaded one none.
Roots roots_of(const RollerForces &rollers)
{
  const Index modes = rollers.slope.rows();
  Roots roots;
  for (std::size_t j = 0; j < rollers.on_raceway.size(); ++j) {
    if (!rollers.on_raceway[j])
      continue;
    const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
        MatrixXd(rollers.slope.middleCols(Index(j) * modes, modes)));
    for (Index i = 0; i < modes; ++i)
      if (eigen.eigenvalues()[i] > 1e-14 * eigen.eigenvalues()[modes - 1])
        roots.emplace_back(j, std::sqrt(eigen.eigenvalues()[i]) * eigen.eigenvectors().col(i));
  }
  return roots;
}

// H^-1 of both right sides.
void solve_rings(BearingStiffness &k, const Roots &roots, const VectorXd &imbalance, const Index ring_modes)
{
  const Index rank = Index(roots.size()), n = k.press.cols();
  MatrixXd H = MatrixXd::Identity(rank, rank);
  for (Index i = 0; i < rank; ++i) {
    const auto &[j, v] = roots[std::size_t(i)];
    H.col(i) += k.bend.middleCols(j * ring_modes, ring_modes) * v.head(ring_modes);
  }
  MatrixXd right(rank, n + 1);
  right << k.press, k.bend * imbalance;
  const Eigen::LLT<MatrixXd> llt(H);
  // A computed flexibility may be indefinite in its last digits; H then still has an inverse.
  const MatrixXd out = llt.info() == Eigen::Success ? MatrixXd(llt.solve(right)) : H.partialPivLu().solve(right);
  k.solved           = out.leftCols(n);
  k.solved_bend      = out.col(n);
}
}  // namespace

BearingStiffness bearing_stiffness(const RollerForces &rollers, const MatrixXd &press, const MatrixXd &flexibility,
                                   const VectorXd &imbalance)
{
  const Roots roots = roots_of(rollers);
  const Index rank = Index(roots.size()), modes = rollers.slope.rows(), count = Index(rollers.on_raceway.size()),
              ring_modes = imbalance.size() / count;
  BearingStiffness k;
  k.root = MatrixXd::Zero(count * modes, rank);
  k.press.resize(rank, press.cols());
  k.bend.resize(rank, imbalance.size());
  for (Index i = 0; i < rank; ++i) {
    const auto &[j, v]                   = roots[std::size_t(i)];
    k.root.block(j * modes, i, modes, 1) = v;
    k.press.row(i)                       = v.transpose() * press.middleRows(j * modes, modes);
    if (ring_modes)
      k.bend.row(i) = v.head(ring_modes).transpose() * flexibility.middleRows(j * ring_modes, ring_modes);
  }
  if (ring_modes) {
    solve_rings(k, roots, imbalance, ring_modes);
  } else {
    k.solved      = k.press;
    k.solved_bend = VectorXd::Zero(rank);
  }
  k.tangent = k.press.transpose() * k.solved;
  k.tangent = (k.tangent + k.tangent.transpose()).eval() / 2;
  return k;
}
}  // namespace mill::bearing
