#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <vector>

namespace mill::fem {
/// LU factorisation of an unsymmetric sparse matrix by UMFPACK; the analysis is kept while the pattern stays.
/// Runs the BLAS on one thread: its fronts are small, and waiting for a second one costs ten times what it saves.
class UnsymmetricFactor {
public:
  UnsymmetricFactor();
  ~UnsymmetricFactor();
  UnsymmetricFactor(UnsymmetricFactor &&) noexcept;
  /// @param matrix  (n, n) compressed
  /// @return false where the matrix is singular
  bool factorise(const Eigen::SparseMatrix<double> &matrix);
  /// The same of the sum of n x n entries.
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
