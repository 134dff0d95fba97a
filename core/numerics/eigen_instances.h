#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <complex>

// Decompositions of dynamic matrices are compiled once, in core/numerics/instances, and not again in every object
// that uses one.  The precompiled headers hold these declarations; without them only the time to compile differs.
// The lists name what Eigen 3.4 does not inline; with another version of Eigen nothing is declared.
#if EIGEN_WORLD_VERSION == 3 && EIGEN_MAJOR_VERSION == 4
#define MILL_EIGEN_INSTANCES

/// Products and triangular solutions.  `how`: extern template, or template where they are defined.
#define MILL_MATRIX_VECTOR(how, Scalar, Left, Right, version)                                                     \
  how struct general_matrix_vector_product<Index, Scalar, const_blas_data_mapper<Scalar, Index, Left>, Left,      \
                                           false, Scalar, const_blas_data_mapper<Scalar, Index, Right>, false,    \
                                           version>;
#define MILL_PRODUCT_INSTANCES(how)                                                                               \
  MILL_MATRIX_VECTOR(how, double, ColMajor, RowMajor, 0)                                                          \
  MILL_MATRIX_VECTOR(how, double, RowMajor, ColMajor, 0)                                                          \
  MILL_MATRIX_VECTOR(how, double, RowMajor, RowMajor, 1)                                                          \
  MILL_MATRIX_VECTOR(how, std::complex<double>, RowMajor, ColMajor, 0)                                            \
  how struct gebp_kernel<double, double, Index, blas_data_mapper<double, Index, ColMajor, Unaligned, 1>,          \
                         gebp_traits<double, double>::mr, gebp_traits<double, double>::nr, false, false>;         \
  how struct selfadjoint_matrix_vector_product<double, Index, ColMajor, Lower, false, false, 0>;                  \
  how struct triangular_solve_vector<double, double, Index, OnTheLeft, Lower | UnitDiag, false, ColMajor>;        \
  how struct triangular_solve_vector<double, double, Index, OnTheLeft, Upper, false, ColMajor>;                   \
  how struct triangular_solve_vector<double, double, Index, OnTheLeft, Lower, false, ColMajor>;                   \
  how struct partial_lu_impl<double, ColMajor, int, -1>;                                                          \
  how struct partial_lu_impl<std::complex<double>, ColMajor, int, -1>;                                            \
  how struct llt_inplace<double, Lower>;                                                                          \
  how bool ldlt_inplace<Lower>::unblocked(MatrixXd &, Transpositions<-1, -1, int> &, VectorXd &, SignMatrix &);

#define MILL_FACTOR_INSTANCES(how)                                                                                \
  how class PartialPivLU<MatrixXd>;                                                                               \
  how class PartialPivLU<MatrixXcd>;                                                                              \
  how class FullPivLU<MatrixXd>;                                                                                  \
  how class LLT<MatrixXd>;                                                                                        \
  how class LDLT<MatrixXd>;                                                                                       \
  how LLT<MatrixXd> &LLT<MatrixXd>::compute(const EigenBase<MatrixXd> &);                                         \
  how LDLT<MatrixXd> &LDLT<MatrixXd>::compute(const EigenBase<MatrixXd> &);

#define MILL_ORTHOGONAL_INSTANCES(how)                                                                            \
  how class HouseholderQR<MatrixXd>;                                                                              \
  how class ColPivHouseholderQR<MatrixXd>;                                                                        \
  how class CompleteOrthogonalDecomposition<MatrixXd>;                                                            \
  how class JacobiSVD<MatrixXd>;                                                                                  \
  how class JacobiSVD<MatrixXcd>;

#define MILL_EIGENVALUE_INSTANCES(how)                                                                            \
  how class HessenbergDecomposition<MatrixXd>;                                                                    \
  how class RealSchur<MatrixXd>;                                                                                  \
  how class EigenSolver<MatrixXd>;                                                                                \
  how RealSchur<MatrixXd> &RealSchur<MatrixXd>::compute(const EigenBase<MatrixXd> &, bool);                       \
  how EigenSolver<MatrixXd> &EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd> &, bool);

#define MILL_SYMMETRIC_INSTANCES(how)                                                                             \
  how class SelfAdjointEigenSolver<MatrixXd>;                                                                     \
  how class GeneralizedSelfAdjointEigenSolver<MatrixXd>;                                                          \
  how SelfAdjointEigenSolver<MatrixXd> &SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd> &,    \
                                                                                  int);                           \
  how void internal::tridiagonalization_inplace(MatrixXd &, VectorXd &);                                          \
  how ComputationInfo internal::computeFromTridiagonal_impl(VectorXd &, VectorXd &, Index, bool, MatrixXd &);

namespace Eigen {
namespace internal {
MILL_PRODUCT_INSTANCES(extern template)
}
MILL_FACTOR_INSTANCES(extern template)
MILL_ORTHOGONAL_INSTANCES(extern template)
MILL_EIGENVALUE_INSTANCES(extern template)
MILL_SYMMETRIC_INSTANCES(extern template)
}  // namespace Eigen
#endif
