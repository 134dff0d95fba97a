#include "tests/support/exact_hold.h"
#include <Eigen/LU>
#include <cmath>

namespace {
using Real   = long double;
using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<Real, Eigen::Dynamic, 1>;

Matrix exponential(const Matrix &G)
{
  const Real norm    = G.cwiseAbs().colwise().sum().maxCoeff();
  const int halvings = std::max(0, int(std::ceil(std::log2(norm))) + 2);  // norm of the scaled matrix below 1/4
  const Matrix small = G / std::exp2(Real(halvings));
  Matrix term = Matrix::Identity(G.rows(), G.cols()), sum = term;
  for (int k = 1; k <= 20; ++k) {  // 0.25^21/21! = 4e-33
    term = term * small / Real(k);
    sum += term;
  }
  for (int i = 0; i < halvings; ++i)
    sum = sum * sum;
  return sum;
}
}  // namespace

Eigen::MatrixXd exact_hold(const Eigen::VectorXd &M, const Eigen::MatrixXd &K, const Eigen::MatrixXd &C,
                           const Eigen::VectorXd &b, const Eigen::VectorXd &force, const double h)
{
  const Eigen::Index n = M.size(), s = 2 * n;
  const Vector inverse      = M.cast<Real>().cwiseInverse();
  const Vector push         = inverse.cwiseProduct(b.cast<Real>());
  Matrix A                  = Matrix::Zero(s, s);
  A.topRightCorner(n, n)    = Matrix::Identity(n, n);
  A.bottomLeftCorner(n, n)  = -(inverse.asDiagonal() * K.cast<Real>());
  A.bottomRightCorner(n, n) = -(inverse.asDiagonal() * C.cast<Real>());
  Matrix G                  = Matrix::Zero(s + 2, s + 2);
  G.topLeftCorner(s, s)     = Real(h) * A;
  G.col(s).segment(n, n)    = Real(h) * push;
  G(s, s + 1)               = 1;
  const Matrix E            = exponential(G);

  Vector x  = Vector::Zero(s);
  x.head(n) = K.cast<Real>().partialPivLu().solve(b.cast<Real>()) * Real(force[0]);
  Eigen::MatrixXd acceleration(force.size(), n);
  for (Eigen::Index i = 0; i < force.size(); ++i) {
    acceleration.row(i) = (A.bottomRows(n) * x + push * Real(force[i])).transpose().cast<double>();
    if (i + 1 < force.size())
      x = E.topLeftCorner(s, s) * x + E.col(s).head(s) * Real(force[i]) +
          E.col(s + 1).head(s) * (Real(force[i + 1]) - Real(force[i]));
  }
  return acceleration;
}
