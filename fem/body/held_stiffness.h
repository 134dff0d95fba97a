#pragma once
#include "core/numerics/sparse.h"
#include "fem/body/free_unknowns.h"
#include <Eigen/Core>
#include <vector>

namespace mill::fem {
/// A stiffness of three unknowns per node with some of them held at zero, factorised.
class HeldStiffness {
public:
  /// @param stiffness  (3 N, 3 N) upper triangle
  /// @param held       (3 N) 1: held
  /// @throws SolverError  rigid motions left
  HeldStiffness(const SymmetricSparse &stiffness, const std::vector<char> &held);
  /// (k, k): displacements along the loads (3 N, k) under these loads; what falls on held unknowns does nothing.
  Eigen::MatrixXd flexibility(const Eigen::MatrixXd &loads) const;
  /// (3 N, k): displacements, zero where held.
  Eigen::MatrixXd displacement(const Eigen::MatrixXd &loads) const;
  int n_unknowns() const;  ///< free ones

private:
  Eigen::MatrixXd on_free(const Eigen::MatrixXd &loads) const;
  FreeUnknowns free;  // its matrix is emptied once it is factorised
  CondensingFactor factor;
};
}  // namespace mill::fem
