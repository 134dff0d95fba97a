#pragma once
#include "dynamics/chatter/speed.h"
#include <Eigen/Core>

// Stability without eigenvalues: Routh's array of the characteristic polynomial.  theory.md 25.4
namespace mill::dynamics {
struct RouthCount {
  int unstable = 0;              ///< roots with a real part above the line
  int on_axis  = 0;              ///< roots on the line itself
  int digits   = 0;              ///< of the arithmetic that was needed
  Eigen::VectorXd first_column;  ///< (s+1) of the array in scaled time; a change of sign is an unstable root
};

/// Routh's array of the characteristic polynomial, in as many decimal digits as the matrix needs (100, 200 or 400,
/// judged by Cayley and Hamilton's theorem).  The polynomial is Faddeev and LeVerrier's up to 16 states, one by
/// elimination above.  The entries of A are taken as exact, so that a root on the line is distinguished from one
/// next to it. Where a leading zero would stop the array, the polynomial is taken times a factor with a known root
/// on the left, of which the first column then has one entry more.
/// @param right_of  1/s, the line; 0: the imaginary axis
/// @throws SolverError  400 digits do not do
/// Cost: 2 ms for 14 states, 50 ms for 42.
/// Source: D. K. Faddeev, V. N. Faddeeva, Computational Methods of Linear Algebra (1963); F. R. Gantmacher, The
/// Theory of Matrices (1959), volume 2, chapter 15.
RouthCount routh_count(const Eigen::MatrixXd &A, double right_of = 0);

/// Number of roots with a positive real part.
int unstable_roots(const Eigen::MatrixXd &A);

/// The same in double precision and without its checks: what a plain program finds.  Wrong for roots far apart, as
/// those of a stand with very strong dampers.
RouthCount routh_count_in_double(const Eigen::MatrixXd &A);

/// Speed between `low` and `high` at which the number of unstable roots begins to differ from that at `low`, by
/// halving, m/s.
double boundary_by_routh(const MatrixAtSpeed &matrix, double low, double high, double tolerance = 1e-6);
}  // namespace mill::dynamics
