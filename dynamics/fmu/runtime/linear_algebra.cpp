#include "linear_algebra.h"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace mill::fmu {
namespace {
using Complex = std::complex<double>;

// One rotation of Jacobi's method that makes A(p, q) zero.
void rotate(Matrix &A, Matrix &V, const std::size_t p, const std::size_t q)
{
  const double apq = A(p, q);
  if (apq == 0)
    return;
  const double theta = (A(q, q) - A(p, p)) / (2 * apq);
  const double t     = std::copysign(1.0, theta) / (std::abs(theta) + std::hypot(theta, 1.0));
  const double c = 1 / std::hypot(t, 1.0), s = t * c;
  A(p, p) -= t * apq;
  A(q, q) += t * apq;
  A(p, q) = A(q, p) = 0;
  for (std::size_t k = 0; k < A.rows; ++k) {
    if (k != p && k != q) {
      const double akp = A(k, p), akq = A(k, q);
      A(k, p) = A(p, k) = c * akp - s * akq;
      A(k, q) = A(q, k) = s * akp + c * akq;
    }
    const double vkp = V(k, p), vkq = V(k, q);
    V(k, p) = c * vkp - s * vkq;
    V(k, q) = s * vkp + c * vkq;
  }
}

// Householder reduction to Hessenberg form, H = Q^T A Q, with Q gathered.
void reduce_to_hessenberg(Matrix &H, Matrix &Q)
{
  const std::size_t n = H.rows;
  std::vector<double> v(n);
  for (std::size_t k = 0; k + 2 < n; ++k) {
    double norm = 0;
    for (std::size_t i = k + 1; i < n; ++i)
      norm = std::hypot(norm, H(i, k));
    if (norm == 0)
      continue;
    for (std::size_t i = k + 1; i < n; ++i)
      v[i] = H(i, k);
    v[k + 1] += std::copysign(norm, v[k + 1]);
    double vv = 0;
    for (std::size_t i = k + 1; i < n; ++i)
      vv += v[i] * v[i];
    const auto reflect = [&](Matrix &A, const bool rows, const std::size_t from) {
      for (std::size_t j = from; j < n; ++j) {
        double dot = 0;
        for (std::size_t i = k + 1; i < n; ++i)
          dot += v[i] * (rows ? A(i, j) : A(j, i));
        dot *= 2 / vv;
        for (std::size_t i = k + 1; i < n; ++i)
          (rows ? A(i, j) : A(j, i)) -= dot * v[i];
      }
    };
    reflect(H, true, k);
    reflect(H, false, 0);
    reflect(Q, false, 0);
    for (std::size_t i = k + 2; i < n; ++i)
      H(i, k) = 0;
  }
}

// Wilkinson's shift: the eigenvalue of the trailing 2 x 2 block that is nearer to its last entry.
Complex shift_of(const ComplexMatrix &T, const std::size_t hi)
{
  const Complex a = T(hi - 1, hi - 1), b = T(hi - 1, hi), c = T(hi, hi - 1), d = T(hi, hi);
  const Complex half = 0.5 * (a - d), root = std::sqrt(half * half + b * c);
  const Complex one = d - b * c / (half + root), two = d - b * c / (half - root);
  const bool first = std::abs(half + root) >= std::abs(half - root);
  if ((first ? half + root : half - root) == Complex(0))
    return d;
  return first ? one : two;
}

// One QR step with the given shift on rows lo..hi, by Givens rotations.
void qr_step(ComplexMatrix &T, ComplexMatrix &Q, const std::size_t lo, const std::size_t hi, const Complex shift)
{
  const std::size_t n = T.rows;
  std::vector<std::pair<double, Complex>> rotations;
  for (std::size_t i = lo; i <= hi; ++i)
    T(i, i) -= shift;
  for (std::size_t k = lo; k < hi; ++k) {
    const Complex x = T(k, k), y = T(k + 1, k);
    const double r  = std::hypot(std::abs(x), std::abs(y));
    const double c  = r == 0 ? 1 : std::abs(x) / r;
    const Complex s = r == 0             ? Complex(0)
                      : std::abs(x) == 0 ? std::conj(y) / r
                                         : (x / std::abs(x)) * std::conj(y) / r;
    rotations.push_back({c, s});
    for (std::size_t j = k; j < n; ++j) {
      const Complex t = T(k, j), u = T(k + 1, j);
      T(k, j)     = c * t + s * u;
      T(k + 1, j) = -std::conj(s) * t + c * u;
    }
  }
  for (std::size_t k = lo; k < hi; ++k) {
    const auto [c, s] = rotations[k - lo];
    const auto turn   = [&, c = c, s = s](ComplexMatrix &A, const std::size_t rows) {
      for (std::size_t i = 0; i < rows; ++i) {
        const Complex t = A(i, k), u = A(i, k + 1);
        A(i, k)     = c * t + std::conj(s) * u;
        A(i, k + 1) = -s * t + c * u;
      }
    };
    turn(T, std::min(k + 2, hi) + 1);
    turn(Q, n);
  }
  for (std::size_t i = lo; i <= hi; ++i)
    T(i, i) += shift;
}

// Brings T (Hessenberg) to triangular form, A = Q T Q^H.  False: no end after many steps.
bool triangularise(ComplexMatrix &T, ComplexMatrix &Q)
{
  std::size_t hi = T.rows - 1;
  int steps      = 0;
  while (hi > 0) {
    std::size_t lo = hi;
    for (; lo > 0; --lo) {
      const double neighbours = std::abs(T(lo, lo)) + std::abs(T(lo - 1, lo - 1));
      if (std::abs(T(lo, lo - 1)) <= std::numeric_limits<double>::epsilon() * neighbours) {
        T(lo, lo - 1) = 0;
        break;
      }
    }
    if (lo == hi) {
      --hi;
      steps = 0;
      continue;
    }
    if (++steps > 100)
      return false;
    const bool unusual  = steps % 10 == 0;  // breaks a cycle of the iteration
    const Complex shift = unusual ? T(hi, hi) + std::abs(T(hi, hi - 1)) : shift_of(T, hi);
    qr_step(T, Q, lo, hi, shift);
  }
  return true;
}

// V = Q X, X the eigenvectors of the triangular T by back substitution, columns of length one.
ComplexMatrix eigenvectors(const ComplexMatrix &T, const ComplexMatrix &Q)
{
  const std::size_t n = T.rows;
  ComplexMatrix V(n, n);
  std::vector<Complex> x(n);
  for (std::size_t k = 0; k < n; ++k) {
    x.assign(n, 0);
    x[k] = 1;
    for (std::size_t i = k; i-- > 0;) {
      Complex sum = T(i, k);
      for (std::size_t j = i + 1; j < k; ++j)
        sum += T(i, j) * x[j];
      Complex gap = T(k, k) - T(i, i);
      if (gap == Complex(0))
        gap = std::numeric_limits<double>::epsilon() * (std::abs(T(k, k)) + std::numeric_limits<double>::min());
      x[i] = sum / gap;
    }
    double length = 0;
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j <= k; ++j)
        V(i, k) += Q(i, j) * x[j];
      length = std::hypot(length, std::abs(V(i, k)));
    }
    for (std::size_t i = 0; i < n; ++i)
      V(i, k) /= length;
  }
  return V;
}

// Gauss-Jordan with row pivots.  Empty: singular.
ComplexMatrix inverse_of(ComplexMatrix A)
{
  const std::size_t n = A.rows;
  ComplexMatrix B(n, n);
  for (std::size_t i = 0; i < n; ++i)
    B(i, i) = 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(A(i, k)) > std::abs(A(pivot, k)))
        pivot = i;
    if (!(std::abs(A(pivot, k)) > 0))
      return {};
    for (std::size_t j = 0; j < n; ++j) {
      std::swap(A(k, j), A(pivot, j));
      std::swap(B(k, j), B(pivot, j));
    }
    const Complex scale = 1.0 / A(k, k);
    for (std::size_t j = 0; j < n; ++j) {
      A(k, j) *= scale;
      B(k, j) *= scale;
    }
    for (std::size_t i = 0; i < n; ++i) {
      const Complex factor = A(i, k);
      if (i == k || factor == Complex(0))
        continue;
      for (std::size_t j = 0; j < n; ++j) {
        A(i, j) -= factor * A(k, j);
        B(i, j) -= factor * B(k, j);
      }
    }
  }
  return B;
}

double norm_of(const ComplexMatrix &A)
{
  double most = 0;
  for (std::size_t j = 0; j < A.cols; ++j) {
    double sum = 0;
    for (std::size_t i = 0; i < A.rows; ++i)
      sum += std::abs(A(i, j));
    most = std::max(most, sum);
  }
  return most;
}

Matrix product(const Matrix &A, const Matrix &B)
{
  Matrix C(A.rows, B.cols);
  for (std::size_t i = 0; i < A.rows; ++i)
    for (std::size_t k = 0; k < A.cols; ++k)
      for (std::size_t j = 0; j < B.cols; ++j)
        C(i, j) += A(i, k) * B(k, j);
  return C;
}
}  // namespace

SymmetricEigen symmetric_eigen(Matrix A)
{
  const std::size_t n = A.rows;
  Matrix V(n, n);
  for (std::size_t i = 0; i < n; ++i)
    V(i, i) = 1;
  constexpr int most_sweeps = 60;
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    bool done = true;
    for (std::size_t p = 0; p + 1 < n; ++p)
      for (std::size_t q = p + 1; q < n; ++q)
        if (std::abs(A(p, q)) > 1e-17 * std::sqrt(std::abs(A(p, p) * A(q, q)))) {
          rotate(A, V, p, q);
          done = false;
        }
    if (done)
      break;
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
            [&](const std::size_t a, const std::size_t b) { return A(a, a) < A(b, b); });
  SymmetricEigen result{std::vector<double>(n), Matrix(n, n)};
  for (std::size_t k = 0; k < n; ++k) {
    result.value[k] = A(order[k], order[k]);
    for (std::size_t i = 0; i < n; ++i)
      result.vector(i, k) = V(i, order[k]);
  }
  return result;
}

GeneralEigen general_eigen(const Matrix &A)
{
  const std::size_t n = A.rows;
  Matrix H            = A, basis(n, n);
  for (std::size_t i = 0; i < n; ++i)
    basis(i, i) = 1;
  reduce_to_hessenberg(H, basis);
  ComplexMatrix T(n, n), Q(n, n);
  std::copy(H.entry.begin(), H.entry.end(), T.entry.begin());
  std::copy(basis.entry.begin(), basis.entry.end(), Q.entry.begin());
  GeneralEigen result;
  result.condition = std::numeric_limits<double>::infinity();
  if (!triangularise(T, Q))
    return result;
  result.vector  = eigenvectors(T, Q);
  result.inverse = inverse_of(result.vector);
  for (std::size_t k = 0; k < n; ++k)
    result.value.push_back(T(k, k));
  if (result.inverse.rows == n)
    result.condition = norm_of(result.vector) * norm_of(result.inverse);
  return result;
}

Matrix matrix_exponential(Matrix A)
{
  const std::size_t n = A.rows;
  double norm         = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j)
      sum += std::abs(A(i, j));
    norm = std::max(norm, sum);
  }
  int squarings = 0;
  for (; norm > 0.5; norm /= 2)
    ++squarings;
  for (double &a : A.entry)
    a = std::ldexp(a, -squarings);
  // Horner on 1 + A (1 + A/2 (1 + A/3 ...)); what is squared is exp(A) - 1, so that nothing small is lost
  // compared with 1.
  constexpr int degree = 18;
  Matrix E(n, n);
  for (int k = degree; k >= 1; --k) {
    for (std::size_t i = 0; i < n; ++i)
      E(i, i) += 1;
    E = product(A, E);
    for (double &e : E.entry)
      e /= k;
  }
  for (; squarings > 0; --squarings) {
    const Matrix square = product(E, E);  // (1 + E)^2 - 1 = 2 E + E^2
    for (std::size_t i = 0; i < E.entry.size(); ++i)
      E.entry[i] = 2 * E.entry[i] + square.entry[i];
  }
  for (std::size_t i = 0; i < n; ++i)
    E(i, i) += 1;
  return E;
}
}  // namespace mill::fmu
