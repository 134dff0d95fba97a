#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace mill::fem {
/// LU factorisation of an unsymmetric sparse matrix by UMFPACK; analysis and places are kept while entries
/// come in the same order.
/// Runs the BLAS on one thread: its fronts are small, and waiting for a second one costs ten times what it saves.
class UnsymmetricFactor {
public:
  UnsymmetricFactor();
  ~UnsymmetricFactor();
  UnsymmetricFactor(UnsymmetricFactor &&) noexcept;
  /// @param entries  of an (n, n) matrix; those of one place are added
  /// @return false where the matrix is singular
  bool factorise(int n, const std::vector<Eigen::Triplet<double>> &entries);
  /// (n) solution of A x = b without iterative refinement, for Newton's method, whose next step is one.
  Eigen::VectorXd solve(const Eigen::VectorXd &b) const;
  /// (n) solution of A^T x = b, refined.
  Eigen::VectorXd solve_transposed(const Eigen::VectorXd &b) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};
}  // namespace mill::fem
