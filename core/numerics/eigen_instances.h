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

/// Packing of one factor of a product of matrices, and the kernel that multiplies what is packed.  `how`: extern
/// template, or template where they are defined; `Mapper`: const_blas_data_mapper or blas_data_mapper.
#define MILL_PACK_LEFT(how, Scalar, Mapper, Order, panel)                                                         \
  how struct gemm_pack_lhs<Scalar, Index, Mapper<Scalar, Index, Order>, gebp_traits<Scalar, Scalar>::mr,          \
                           gebp_traits<Scalar, Scalar>::LhsProgress,                                              \
                           gebp_traits<Scalar, Scalar>::LhsPacket4Packing, Order, false, panel>;
#define MILL_PACK_RIGHT(how, Scalar, Mapper, Order, panel)                                                        \
  how struct gemm_pack_rhs<Scalar, Index, Mapper<Scalar, Index, Order>, gebp_traits<Scalar, Scalar>::nr, Order,   \
                           false, panel>;
#define MILL_KERNEL(how, Scalar)                                                                                  \
  how struct gebp_kernel<Scalar, Scalar, Index, blas_data_mapper<Scalar, Index, ColMajor>,                        \
                         gebp_traits<Scalar, Scalar>::mr, gebp_traits<Scalar, Scalar>::nr, false, false>;         \
  MILL_PACK_LEFT(how, Scalar, const_blas_data_mapper, ColMajor, false)                                            \
  MILL_PACK_LEFT(how, Scalar, const_blas_data_mapper, RowMajor, false)                                            \
  MILL_PACK_LEFT(how, Scalar, blas_data_mapper, ColMajor, true)                                                   \
  MILL_PACK_RIGHT(how, Scalar, const_blas_data_mapper, ColMajor, false)                                           \
  MILL_PACK_RIGHT(how, Scalar, const_blas_data_mapper, RowMajor, false)                                           \
  MILL_PACK_RIGHT(how, Scalar, const_blas_data_mapper, ColMajor, true)                                            \
  MILL_PACK_RIGHT(how, Scalar, blas_data_mapper, ColMajor, true)

/// Products of two matrices; of a triangular and another; solutions with one and with several right sides.
#define MILL_MATRIX_MATRIX(how, Scalar, Left, Right)                                                              \
  how struct general_matrix_matrix_product<Index, Scalar, Left, false, Scalar, Right, false, ColMajor, 1>;
#define MILL_TRIANGULAR_PRODUCT(how, mode, Order)                                                                 \
  how struct product_triangular_matrix_matrix<double, Index, mode, true, Order, false, ColMajor, false, ColMajor, \
                                              1, Specialized>;
#define MILL_SOLVE_MATRIX(how, Scalar, mode, Order)                                                               \
  how struct triangular_solve_matrix<Scalar, Index, OnTheLeft, mode, false, Order, ColMajor, 1>;
#define MILL_SOLVE_VECTOR(how, mode, Order)                                                                       \
  how struct triangular_solve_vector<double, double, Index, OnTheLeft, mode, false, Order>;
#define MILL_MATRIX_VECTOR(how, Scalar, Left, Right, version)                                                     \
  how struct general_matrix_vector_product<Index, Scalar, const_blas_data_mapper<Scalar, Index, Left>, Left,      \
                                           false, Scalar, const_blas_data_mapper<Scalar, Index, Right>, false,    \
                                           version>;
#define MILL_PRODUCT_INSTANCES(how)                                                                               \
  MILL_KERNEL(how, double)                                                                                        \
  MILL_KERNEL(how, std::complex<double>)                                                                          \
  MILL_MATRIX_MATRIX(how, double, ColMajor, ColMajor)                                                             \
  MILL_MATRIX_MATRIX(how, double, RowMajor, ColMajor)                                                             \
  MILL_MATRIX_MATRIX(how, double, ColMajor, RowMajor)                                                             \
  MILL_MATRIX_MATRIX(how, std::complex<double>, ColMajor, ColMajor)                                               \
  MILL_TRIANGULAR_PRODUCT(how, Lower, ColMajor)                                                                   \
  MILL_TRIANGULAR_PRODUCT(how, Lower | UnitDiag, ColMajor)                                                        \
  MILL_TRIANGULAR_PRODUCT(how, Upper, RowMajor)                                                                   \
  MILL_TRIANGULAR_PRODUCT(how, Upper | UnitDiag, RowMajor)                                                        \
  MILL_SOLVE_MATRIX(how, double, Lower, ColMajor)                                                                 \
  MILL_SOLVE_MATRIX(how, double, Lower | UnitDiag, ColMajor)                                                      \
  MILL_SOLVE_MATRIX(how, double, Upper, ColMajor)                                                                 \
  MILL_SOLVE_MATRIX(how, double, Upper, RowMajor)                                                                 \
  MILL_SOLVE_MATRIX(how, double, Upper | UnitDiag, RowMajor)                                                      \
  MILL_SOLVE_MATRIX(how, std::complex<double>, Lower | UnitDiag, ColMajor)                                        \
  MILL_SOLVE_MATRIX(how, std::complex<double>, Upper, ColMajor)                                                   \
  MILL_SOLVE_VECTOR(how, Lower | UnitDiag, ColMajor)                                                              \
  MILL_SOLVE_VECTOR(how, Lower, ColMajor)                                                                         \
  MILL_SOLVE_VECTOR(how, Upper, ColMajor)                                                                         \
  MILL_SOLVE_VECTOR(how, Upper, RowMajor)                                                                         \
  MILL_SOLVE_VECTOR(how, Upper | UnitDiag, RowMajor)                                                              \
  MILL_MATRIX_VECTOR(how, double, ColMajor, RowMajor, 0)                                                          \
  MILL_MATRIX_VECTOR(how, double, RowMajor, ColMajor, 0)                                                          \
  MILL_MATRIX_VECTOR(how, double, RowMajor, RowMajor, 1)                                                          \
  MILL_MATRIX_VECTOR(how, std::complex<double>, RowMajor, ColMajor, 0)                                            \
  MILL_MATRIX_VECTOR(how, std::complex<double>, ColMajor, RowMajor, 0)                                            \
  MILL_MATRIX_VECTOR(how, std::complex<double>, ColMajor, ColMajor, 0)                                            \
  how struct triangular_matrix_vector_product<Index, Upper | UnitDiag, double, false, double, false, RowMajor,    \
                                              0>;                                                                 \
  how struct selfadjoint_matrix_vector_product<double, Index, ColMajor, Lower, false, false, 0>;                  \
  how struct partial_lu_impl<double, ColMajor, int, -1>;                                                          \
  how struct partial_lu_impl<std::complex<double>, ColMajor, int, -1>;                                            \
  how struct llt_inplace<double, Lower>;                                                                          \
  how bool ldlt_inplace<Lower>::unblocked(MatrixXd &, Transpositions<-1, -1, int> &, VectorXd &, SignMatrix &);

/// Reflections of the QR decompositions.  `Whole`, `Whole_vector`: MatrixXd and VectorXd or the same const.
#define MILL_REFLECT(how, Whole, Whole_vector)                                                                    \
  how void internal::make_block_householder_triangular_factor(                                                    \
      Matrix<double, -1, -1, RowMajor> &, const Block<Whole> &, const Block<Whole_vector, -1, 1> &);              \
  how void internal::apply_block_householder_on_the_left(Block<MatrixXd> &, const Block<Whole> &,                 \
                                                         const Block<Whole_vector, -1, 1> &, bool);
#define MILL_REFLECTION_INSTANCES(how)                                                                            \
  MILL_REFLECT(how, MatrixXd, VectorXd)                                                                           \
  MILL_REFLECT(how, const MatrixXd, const VectorXd)                                                               \
  how void MatrixBase<Block<MatrixXd>>::applyHouseholderOnTheLeft(const Block<const MatrixXd, -1, 1> &,           \
                                                                  const double &, double *);                      \
  how void MatrixBase<Block<MatrixXd>>::applyHouseholderOnTheLeft(                                                \
      const Block<const Block<MatrixXd, -1, 1, true>, -1, 1> &, const double &, double *);                        \
  how void MatrixBase<Block<MatrixXd>>::applyHouseholderOnTheRight(const Block<const MatrixXd, -1, 1> &,          \
                                                                   const double &, double *);

#define MILL_FACTOR_INSTANCES(how)                                                                                \
  how class PartialPivLU<MatrixXd>;                                                                               \
  how class PartialPivLU<MatrixXcd>;                                                                              \
  how class FullPivLU<MatrixXd>;                                                                                  \
  how class LLT<MatrixXd>;                                                                                        \
  how class LDLT<MatrixXd>;                                                                                       \
  how LLT<MatrixXd> &LLT<MatrixXd>::compute(const EigenBase<MatrixXd> &);                                         \
  how LDLT<MatrixXd> &LDLT<MatrixXd>::compute(const EigenBase<MatrixXd> &);                                       \
  how void FullPivLU<MatrixXd>::_solve_impl(const VectorXd &, VectorXd &) const;                                  \
  how void LDLT<MatrixXd>::_solve_impl(const VectorXd &, VectorXd &) const;                                       \
  how void LDLT<MatrixXd>::_solve_impl_transposed<true>(const VectorXd &, VectorXd &) const;                      \
  how void LLT<MatrixXd>::_solve_impl(const VectorXd &, VectorXd &) const;                                        \
  how void LLT<MatrixXd>::_solve_impl(const MatrixXd &, MatrixXd &) const;                                        \
  how void LLT<MatrixXd>::_solve_impl_transposed<true>(const VectorXd &, VectorXd &) const;                       \
  how void LLT<MatrixXd>::_solve_impl_transposed<true>(const MatrixXd &, MatrixXd &) const;

#define MILL_ORTHOGONAL_INSTANCES(how)                                                                            \
  how class HouseholderQR<MatrixXd>;                                                                              \
  how class ColPivHouseholderQR<MatrixXd>;                                                                        \
  how class CompleteOrthogonalDecomposition<MatrixXd>;                                                            \
  how class JacobiSVD<MatrixXd>;                                                                                  \
  how void HouseholderQR<MatrixXd>::_solve_impl(const VectorXd &, VectorXd &) const;                              \
  how void HouseholderQR<MatrixXd>::_solve_impl(const MatrixXd &, MatrixXd &) const;                              \
  how void ColPivHouseholderQR<MatrixXd>::_solve_impl(const VectorXd &, VectorXd &) const;                        \
  how void ColPivHouseholderQR<MatrixXd>::_solve_impl(const MatrixXd &, MatrixXd &) const;                        \
  how void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const VectorXd &, VectorXd &) const;            \
  how void CompleteOrthogonalDecomposition<MatrixXd>::_solve_impl(const MatrixXd &, MatrixXd &) const;

#define MILL_EIGENVALUE_INSTANCES(how)                                                                            \
  how class HessenbergDecomposition<MatrixXd>;                                                                    \
  how class RealSchur<MatrixXd>;                                                                                  \
  how class EigenSolver<MatrixXd>;                                                                                \
  how RealSchur<MatrixXd> &RealSchur<MatrixXd>::compute(const EigenBase<MatrixXd> &, bool);                       \
  how EigenSolver<MatrixXd> &EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd> &, bool);

#define MILL_COMPLEX_INSTANCES(how)                                                                               \
  how class HessenbergDecomposition<MatrixXcd>;                                                                   \
  how class ComplexSchur<MatrixXcd>;                                                                              \
  how class ComplexEigenSolver<MatrixXcd>;                                                                        \
  how ComplexSchur<MatrixXcd> &ComplexSchur<MatrixXcd>::compute(const EigenBase<MatrixXcd> &, bool);              \
  how ComplexEigenSolver<MatrixXcd> &ComplexEigenSolver<MatrixXcd>::compute(const EigenBase<MatrixXcd> &, bool);

#define MILL_SYMMETRIC_INSTANCES(how)                                                                             \
  how class SelfAdjointEigenSolver<MatrixXd>;                                                                     \
  how class GeneralizedSelfAdjointEigenSolver<MatrixXd>;                                                          \
  how SelfAdjointEigenSolver<MatrixXd> &SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd> &,    \
                                                                                  int);                           \
  how void internal::tridiagonalization_inplace(MatrixXd &, VectorXd &);                                          \
  how ComputationInfo internal::computeFromTridiagonal_impl(VectorXd &, VectorXd &, Index, bool, MatrixXd &);     \
  how void internal::tridiagonalization_inplace(MatrixXd &, VectorXd &, VectorXd &, VectorXd &, bool);

namespace Eigen {
namespace internal {
MILL_PRODUCT_INSTANCES(extern template)
}
MILL_FACTOR_INSTANCES(extern template)
MILL_REFLECTION_INSTANCES(extern template)
MILL_ORTHOGONAL_INSTANCES(extern template)
MILL_EIGENVALUE_INSTANCES(extern template)
MILL_COMPLEX_INSTANCES(extern template)
MILL_SYMMETRIC_INSTANCES(extern template)
}  // namespace Eigen
#endif
