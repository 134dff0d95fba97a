#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>
#include <string>
#include <vector>

namespace mill {
/// Symmetric positive definite matrix, upper triangle stored, columns compressed.
using SymmetricSparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// What a factorisation will cost, known after the analysis and before any number is computed.
struct FactorCost {
  double n_nonzeros = 0;  ///< of the factor
  double n_flops    = 0;  ///< of the factorisation
  double bytes      = 0;  ///< of the factor
};

/// Supernodal Cholesky factorisation K = L L^T whose last rows belong to a retained set, so that the trailing
/// block of L is the Cholesky factor of the Schur complement onto it: condensation costs nothing beyond the
/// factorisation. theory.md (2.2)
class CondensingFactor {
public:
  /// @param K         (n, n) upper triangle, positive definite
  /// @param node_of   (n) node each unknown belongs to; METIS orders the graph of nodes, which is three times
  /// smaller
  /// @param retained  (m) unknowns to keep, in the order wanted in schur_factor(); may be empty
  /// @param available bytes that may be taken; 0: what the process has left (core/process/memory.h)
  /// @throws SolverError  factor, Schur complement and its inverse need more (known before), or K is not definite
  CondensingFactor(const SymmetricSparse &K, const std::vector<int> &node_of, const std::vector<int> &retained,
                   double available = 0);
  ~CondensingFactor();
  CondensingFactor(CondensingFactor &&) noexcept;

  /// (m, m) lower triangular L22 with L22 L22^T = S = K_rr - K_ri K_ii^-1 K_ir, rows in the order of `retained`.
  Eigen::MatrixXd schur_factor() const;
  /// (n, k) solution of K X = B.
  Eigen::MatrixXd solve(const Eigen::MatrixXd &B) const;
  const FactorCost &cost() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> self;
};

/// S^-1 from the lower triangular Cholesky factor of S; both triangles filled.
Eigen::MatrixXd inverse_from_factor(const Eigen::MatrixXd &lower);

/// Path of the shared object that provides dgemm_, for instance ".../openblas-openmp/libblas.so.3".
std::string blas_in_use();
/// True for Debian's reference BLAS, which is 6 to 20 times slower than OpenBLAS.
bool is_reference_blas(const std::string &path);
/// OpenBLAS chooses its kernels when it is loaded and falls back to those of 2004 on a processor it does not know,
/// which costs a factor of four.  The value of OPENBLAS_CORETYPE that makes it take those the instruction set
/// allows; null where the right ones are in use or it is another BLAS.
const char *fast_blas_kernels();
/// Threads the BLAS may use; no effect on the reference BLAS.
void set_blas_threads(int n);
}  // namespace mill
