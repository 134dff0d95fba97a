#pragma once
#include <complex>
#include <cstddef>
#include <vector>

// Dense matrices of a few to a few hundred rows, without any library: this code travels inside the exported
// archive.
namespace mill::fmu {
/// Row-major matrix.
template <class T> struct Dense {
  std::size_t rows = 0, cols = 0;
  std::vector<T> entry;  ///< (rows * cols)
  Dense() = default;
  Dense(const std::size_t r, const std::size_t c) : rows(r), cols(c), entry(r * c) {}
  T &operator()(const std::size_t i, const std::size_t j)
  {
    return entry[i * cols + j];
  }
  const T &operator()(const std::size_t i, const std::size_t j) const
  {
    return entry[i * cols + j];
  }
};
using Matrix        = Dense<double>;
using ComplexMatrix = Dense<std::complex<double>>;

/// Eigenvalues, ascending, and orthonormal eigenvectors (columns) of a symmetric matrix by Jacobi's rotations:
/// small eigenvalues keep their relative accuracy better than by tridiagonalisation.  Cost some 10 n^3 a sweep,
/// five to eight sweeps.
struct SymmetricEigen {
  std::vector<double> value;  ///< (n)
  Matrix vector;              ///< (n, n)
};
SymmetricEigen symmetric_eigen(Matrix A);

/// A = V diag(value) V^-1 of a real matrix, and the condition of V in the 1-norm.  Infinite condition: A is
/// defective, or the iteration did not end.
struct GeneralEigen {
  std::vector<std::complex<double>> value;  ///< (n)
  ComplexMatrix vector, inverse;            ///< (n, n)
  double condition = 0;                     ///< -, |V| |V^-1|
};
/// Complex QR iteration with shifts after reduction to Hessenberg form.  Cost O(n^3), about 100 n^3.
/// Source: G. H. Golub, C. F. Van Loan, Matrix Computations, 7.4 and 7.5.
GeneralEigen general_eigen(const Matrix &A);

/// exp(A) by scaling, the Taylor polynomial of degree 18 and squaring: for norms below 1/2 the remainder is
/// 0.5^19/19! = 2e-23.
Matrix matrix_exponential(Matrix A);
}  // namespace mill::fmu
