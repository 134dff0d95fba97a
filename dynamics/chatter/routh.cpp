#include "dynamics/chatter/routh.h"
#include "core/base/errors.h"
#include "core/numerics/root_search.h"
#include <Eigen/LU>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>
#include <vector>

namespace mill::dynamics {
namespace {
template <unsigned digits>
using Digits =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<digits>, boost::multiprecision::et_off>;

template <class Real> using Polynomial = std::vector<Real>;  // falling powers, the first is 1

template <class Real> Real magnitude(const Real &x)
{
  return x < 0 ? Real(-x) : x;
}

// Unit of time in which the roots are about one: the geometric mean of their moduli, to a power of two, so that
// the scaled entries stay exact.  1/s
double time_scale(const Eigen::MatrixXd &A)
{
  const Eigen::VectorXd d = balance(A);
  const Eigen::MatrixXd B = d.cwiseInverse().asDiagonal() * A * d.asDiagonal();
  const Eigen::VectorXd u = B.partialPivLu().matrixLU().diagonal().cwiseAbs();
  const double mean       = std::exp2(u.array().log2().mean());
  const double scale      = mean > 0 && std::isfinite(mean) ? mean : B.norm();
  return scale > 0 && std::isfinite(scale) ? std::exp2(std::round(std::log2(scale))) : 1;
}

// Coefficients at the end that are zero but for rounding: no polynomial of a matrix of doubles near one ends on
// less than about 1e-16 to the number of its states.  Only 400 digits distinguish that from a small number.
template <class Real> void drop_roots_at_zero(Polynomial<Real> &p)
{
  if (std::numeric_limits<Real>::digits10 < 300)
    return;
  for (std::size_t i = p.size(); i-- > 1 && magnitude(p[i]) < Real(1e-250);)
    p[i] = 0;
}

template <class Real> struct Entry {
  std::size_t row, column;
  Real value;
};

// Entries of A less the shift that are not zero: a stand's matrix has few.
template <class Real> std::vector<Entry<Real>> entries_of(const Eigen::MatrixXd &A, const Real &shift)
{
  std::vector<Entry<Real>> entries;
  for (Eigen::Index i = 0; i < A.rows(); ++i)
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      const Real value = i == j ? Real(Real(A(i, j)) - shift) : Real(A(i, j));
      if (value != 0)
        entries.push_back({std::size_t(i), std::size_t(j), value});
    }
  return entries;
}

// Faddeev and LeVerrier:  N_1 = I,  c_k = -tr(A N_k)/k,  N_k+1 = A N_k + c_k I.  s^4 multiplications.
template <class Real>
Polynomial<Real> polynomial_by_traces(const std::vector<Entry<Real>> &entries, const std::size_t s)
{
  std::vector<Real> N(s * s, Real(0)), AN;
  for (std::size_t i = 0; i < s; ++i)
    N[i * s + i] = 1;
  Polynomial<Real> p{Real(1)};
  for (std::size_t k = 1; k <= s; ++k) {
    AN.assign(N.size(), Real(0));
    for (const Entry<Real> &e : entries)
      for (std::size_t j = 0; j < s; ++j)
        AN[e.row * s + j] += e.value * N[e.column * s + j];
    Real trace(0);
    for (std::size_t i = 0; i < s; ++i)
      trace += AN[i * s + i];
    const Real c = -trace / Real(double(k));
    p.push_back(c);
    N = AN;
    for (std::size_t i = 0; i < s; ++i)
      N[i * s + i] += c;
  }
  return p;
}

// The same by elimination to a matrix H with one diagonal below the main one, and the recurrence of its leading
// minors,  p_k = (x - H_kk) p_k-1 - sum_i H_k-i,k H_k,k-1 ... H_k-i+1,k-i p_k-i-1.  s^3 multiplications.
// Source: J. H. Wilkinson, The Algebraic Eigenvalue Problem (1965), chapters 6 and 7.
template <class Real>
Polynomial<Real> polynomial_by_elimination(const std::vector<Entry<Real>> &entries, const std::size_t s)
{
  std::vector<Real> H(s * s, Real(0));
  const auto value_at = [&](const std::size_t i, const std::size_t j) -> Real & { return H[i * s + j]; };
  for (const Entry<Real> &e : entries)
    value_at(e.row, e.column) = e.value;
  for (std::size_t m = 1; m + 1 < s; ++m) {
    std::size_t pivot = m;
    for (std::size_t i = m; i < s; ++i)
      if (magnitude(value_at(i, m - 1)) > magnitude(value_at(pivot, m - 1)))
        pivot = i;
    if (value_at(pivot, m - 1) == 0)
      continue;
    for (std::size_t j = 0; j < s && pivot != m; ++j)
      std::swap(value_at(pivot, j), value_at(m, j));
    for (std::size_t i = 0; i < s && pivot != m; ++i)
      std::swap(value_at(i, pivot), value_at(i, m));
    for (std::size_t i = m + 1; i < s; ++i) {
      if (value_at(i, m - 1) == 0)
        continue;
      const Real y = value_at(i, m - 1) / value_at(m, m - 1);
      for (std::size_t j = m - 1; j < s; ++j)
        value_at(i, j) -= y * value_at(m, j);
      for (std::size_t j = 0; j < s; ++j)
        value_at(j, m) += y * value_at(j, i);
    }
  }
  std::vector<Polynomial<Real>> minors{{Real(1)}};  // rising powers here
  for (std::size_t k = 0; k < s; ++k) {
    Polynomial<Real> p(k + 2, Real(0));
    for (std::size_t j = 0; j <= k; ++j) {
      p[j + 1] += minors[k][j];
      p[j] -= value_at(k, k) * minors[k][j];
    }
    Real product(1);
    for (std::size_t i = 1; i <= k; ++i) {
      product *= value_at(k - i + 1, k - i);
      const Real factor = product * value_at(k - i, k);
      for (std::size_t j = 0; j <= k - i; ++j)
        p[j] -= factor * minors[k - i][j];
    }
    minors.push_back(std::move(p));
  }
  return {minors.back().rbegin(), minors.back().rend()};
}

// Residual of Cayley and Hamilton's theorem, p(A) v = 0 by Horner's scheme, over the last coefficient that is not
// zero.
template <class Real>
Real defect(const Polynomial<Real> &p, const std::vector<Entry<Real>> &entries, const std::size_t s)
{
  std::vector<Real> v(s), x(s, Real(0)), Ax;
  for (std::size_t i = 0; i < s; ++i)
    v[i] = 1 + Real(double(i)) / 8;
  Real last(1);
  for (const Real &c : p) {
    Ax.assign(s, Real(0));
    for (const Entry<Real> &e : entries)
      Ax[e.row] += e.value * x[e.column];
    for (std::size_t i = 0; i < s; ++i)
      x[i] = Ax[i] + c * v[i];
    last = c != 0 ? magnitude(c) : last;
  }
  Real largest(0);
  for (const Real &component : x)
    largest = std::max(largest, magnitude(component));
  return largest / last;
}

// Whether a number is the rounding of a difference of two of that size.
template <class Real> bool vanishes(const Real &x, const Real &size)
{
  using std::sqrt;
  static const Real small = std::numeric_limits<Real>::digits10 > 20 ? sqrt(std::numeric_limits<Real>::epsilon())
                                                                     : Real(0);  // a plain program does not look
  return magnitude(x) <= small * size;
}

struct Array {
  int changes = 0, on_axis = 0;
  bool stuck = false;  ///< a leading entry vanishes in a row that does not
  Eigen::VectorXd first_column;
};

// Routh's array.  A row that vanishes means roots symmetric to the origin, those of the row above read as an
// even or odd polynomial; its derivative takes the place of the row.  Of these roots, as many are on the right as
// on the left, and the changes of sign from there on count the right ones; the rest lies on the axis.
template <class Real> Array routh_array(const Polynomial<Real> &p)
{
  const std::size_t degree = p.size() - 1;
  std::vector<Real> above, row, next;
  for (std::size_t i = 0; i < p.size(); ++i)
    (i % 2 ? row : above).push_back(p[i]);
  Array result;
  result.first_column.resize(Eigen::Index(p.size()));
  result.first_column[0] = double(above[0]);
  std::size_t symmetric  = 0;  // degree of the first polynomial of symmetric roots
  int changes_before     = 0;
  bool positive          = above[0] > 0;
  std::vector<Real> size(row.size());  // of the terms of which each entry is the difference
  for (std::size_t i = 0; i < row.size(); ++i)
    size[i] = magnitude(row[i]);
  for (std::size_t power = degree; power-- > 0;) {  // `row` holds the coefficients of s^power, s^(power-2), ...
    row.resize(power / 2 + 1, Real(0));
    bool empty = true;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (vanishes(row[i], size[i]))
        row[i] = 0;
      empty = empty && row[i] == 0;
    }
    if (empty) {
      if (symmetric == 0) {
        symmetric      = power + 1;
        changes_before = result.changes;
      }
      for (std::size_t i = 0; i < row.size(); ++i)
        row[i] = above[i] * Real(double(power + 1 - 2 * i));
    }
    if (row[0] == 0) {
      result.stuck = true;
      return result;
    }
    result.first_column[Eigen::Index(degree - power)] = double(row[0]);
    if ((row[0] > 0) != positive) {
      ++result.changes;
      positive = row[0] > 0;
    }
    next.assign(power == 0 ? 0 : (power - 1) / 2 + 1, Real(0));
    size.assign(next.size(), Real(0));
    for (std::size_t i = 0; i < next.size(); ++i) {
      const Real first  = i + 1 < above.size() ? above[i + 1] : Real(0);
      const Real second = i + 1 < row.size() ? Real(above[0] / row[0] * row[i + 1]) : Real(0);
      next[i]           = first - second;
      size[i]           = magnitude(first) + magnitude(second);
    }
    above = row;
    row   = next;
  }
  if (symmetric > 0)
    result.on_axis = int(symmetric) - 2 * (result.changes - changes_before);
  return result;
}

// Times (s + a): one more root, on the left.
template <class Real> Polynomial<Real> times_root(const Polynomial<Real> &p, const Real &a)
{
  Polynomial<Real> q = p;
  q.push_back(Real(0));
  for (std::size_t i = 0; i < p.size(); ++i)
    q[i + 1] += a * p[i];
  return q;
}

template <class Real> RouthCount count(const Polynomial<Real> &given)
{
  Polynomial<Real> p = given;
  int at_zero        = 0;
  while (p.size() > 1 && p.back() == 0) {  // a root at the origin itself
    p.pop_back();
    ++at_zero;
  }
  Array array;
  // A leading zero is a property of the array, not of the roots: a factor with a known root on the left moves it.
  for (int attempt = 0; attempt < 5; ++attempt) {
    array = routh_array(p);
    if (!array.stuck)
      break;
    p = times_root(p, Real(1 + 0.37 * attempt));
  }
  if (array.stuck)
    throw SolverError({"chatter: Routh's array has a leading zero that does not go away",
                       fmt::format("polynomial of degree {}, five factors tried", given.size() - 1),
                       "a number that is not finite in the matrix", "judge by the eigenvalues", ""});
  RouthCount result;
  result.unstable     = array.changes;
  result.on_axis      = array.on_axis + at_zero;
  result.first_column = array.first_column;
  return result;
}

// Balancing and time scale by powers of two are exact.
Eigen::MatrixXd scaled(const Eigen::MatrixXd &A, const double scale)
{
  const Eigen::VectorXd d = balance(A);
  return d.cwiseInverse().asDiagonal() * A * d.asDiagonal() / scale;
}

template <unsigned digits> bool counted(const Eigen::MatrixXd &A, const double right_of, RouthCount &result)
{
  using Real                = Digits<digits>;
  const double scale        = time_scale(A);
  const auto entries        = entries_of<Real>(scaled(A, scale), Real(right_of) / Real(scale));
  const auto s              = std::size_t(A.rows());
  constexpr std::size_t few = 16;  // states up to which the slower method takes less time
  Polynomial<Real> p        = s <= few ? polynomial_by_traces(entries, s) : polynomial_by_elimination(entries, s);
  drop_roots_at_zero(p);
  if (!(defect(p, entries, s) <
        pow(std::numeric_limits<Real>::epsilon(), 0.6)))  // distinguishes a zero from a small number
    return false;
  result        = count(p);
  result.digits = int(digits);
  return true;
}
}  // namespace

RouthCount routh_count(const Eigen::MatrixXd &A, const double right_of)
{
  RouthCount result;
  if (counted<100>(A, right_of, result) || counted<200>(A, right_of, result) || counted<400>(A, right_of, result))
    return result;
  throw SolverError({"chatter: the characteristic polynomial is not known well enough for Routh's array",
                     fmt::format("{} states, 400 digits", A.rows()), "roots that are very far apart",
                     "judge by the eigenvalues", ""});
}

int unstable_roots(const Eigen::MatrixXd &A)
{
  return routh_count(A).unstable;
}

RouthCount routh_count_in_double(const Eigen::MatrixXd &A)
{
  const double scale = time_scale(A);
  const auto entries = entries_of<double>(A / scale, 0.);
  RouthCount result  = count(polynomial_by_traces(entries, std::size_t(A.rows())));
  result.digits      = 15;
  return result;
}

double boundary_by_routh(const MatrixAtSpeed &matrix, const double low, const double high, const double tolerance)
{
  const int below   = unstable_roots(matrix(low));
  const Border edge = border_between(
      low, high, [&](const double speed) { return unstable_roots(matrix(speed)) == below; }, tolerance / high);
  return 0.5 * (edge.holds + edge.fails);
}
}  // namespace mill::dynamics
