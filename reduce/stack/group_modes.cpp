#include "reduce/stack/group_modes.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Deflection and rotation of Legendre's polynomials over a roll.
MatrixXd polynomials(const VectorXd &z, const Index n)
{
  const double middle = (z[0] + z[z.size() - 1]) / 2, half = (z[z.size() - 1] - z[0]) / 2;
  MatrixXd X = MatrixXd::Zero(2 * z.size(), n);
  for (Index i = 0; i < z.size(); ++i) {
    const double t = (z[i] - middle) / half;
    double before = 0, value = 1, slope_before = 0, slope = 0;
    for (Index k = 0; k < n; ++k) {
      X(2 * i, k)       = value;
      X(2 * i + 1, k)   = slope / half;
      const double next = ((2 * double(k) + 1) * t * value - double(k) * before) / double(k + 1);
      const double next_slope =
          ((2 * double(k) + 1) * (value + t * slope) - double(k) * slope_before) / double(k + 1);
      before       = value;
      slope_before = slope;
      value        = next;
      slope        = next_slope;
    }
  }
  return X;
}

void normalise(MatrixXd &V, const Index k, const MatrixXd &mass)
{
  for (Index before = 0; before < std::min<Index>(k, 2); ++before)
    V.col(k) -= V.col(before).dot(mass * V.col(k)) * V.col(before);
  V.col(k) /= std::sqrt(V.col(k).dot(mass * V.col(k)));
}
}  // namespace

GroupModes lowest_modes(const RollGroup &group, const int wanted)
{
  const Eigen::SparseMatrix<double> M = group.mass_matrix();
  const Index n                       = std::min<Index>(group.size(), wanted + 8);
  MatrixXd X                          = MatrixXd::NullaryExpr(
                               group.size(), n, [](const Index i, const Index j) { return std::cos(double(1 + i * (j + 1) % 9973)); });
  VectorXd squares = VectorXd::Zero(n);
  for (int round = 0; round < 100; ++round) {
    MatrixXd Y            = M * X;
    const MatrixXd forced = Y;
    group.stiffness.forward(Y);
    group.stiffness.backward(Y);
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> small(Y.transpose() * forced,
                                                                   Y.transpose() * (M * Y));
    const VectorXd before = squares;
    squares               = small.eigenvalues();
    X                     = Y * small.eigenvectors();
    if ((squares - before).head(wanted).cwiseAbs().maxCoeff() < 1e-10 * squares[wanted - 1])
      break;
  }
  return {squares.head(wanted), X.leftCols(wanted)};
}

MatrixXd free_shapes(const RollGroup::FreeBeam &beam, const VectorXd &z, const int bending)
{
  const Index kept = std::min<Index>(2 + bending, beam.mass.rows() - 4);
  MatrixXd X       = polynomials(z, std::min<Index>(kept + 4, beam.mass.rows()));
  MatrixXd rigid   = X.leftCols(2);
  // A shift as large as the first bending keeps the matrix definite.
  const VectorXd parabola = X.col(2);
  const double shift      = parabola.dot(beam.stiffness * parabola) / parabola.dot(beam.mass * parabola);
  const Eigen::LLT<MatrixXd> shifted(beam.stiffness + shift * beam.mass);
  for (int round = 0; round < 6; ++round) {
    const MatrixXd Y = shifted.solve(beam.mass * X);
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> small(Y.transpose() * beam.stiffness * Y,
                                                                   Y.transpose() * beam.mass * Y);
    X = Y * small.eigenvectors();
  }
  X.leftCols(2) = rigid;  // one of them a translation
  for (Index k = 0; k < kept; ++k)
    normalise(X, k, beam.mass);
  return X.leftCols(kept);
}
}  // namespace mill::reduce
