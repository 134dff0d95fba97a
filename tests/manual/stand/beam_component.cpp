#include "tests/manual/stand/beam_component.h"
#include "reduce/chain/roll_body.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mill::verify {
namespace {
double legendre(const int degree, const double x)
{
  double before = 0, now = 1;
  for (int k = 0; k < degree; ++k) {
    const double next = ((2 * k + 1) * x * now - k * before) / (k + 1);
    before            = now;
    now               = next;
  }
  return now;
}

/// (nodes, n_barrel + 1): functionals of the interface.  The coefficients are those of the best fit of the
/// polynomials to the nodes of the barrel, weighted with their share of its length, so that each polynomial gives
/// exactly itself.
Eigen::MatrixXd interface_functionals(const reduce::RollBody &beam, const int n_barrel)
{
  const reduce::LinePoints line = reduce::line_points(beam, beam, beam.half_barrel);
  Eigen::MatrixXd P(line.z.size(), n_barrel);
  for (Eigen::Index i = 0; i < P.rows(); ++i)
    for (int j = 0; j < n_barrel; ++j)
      P(i, j) = legendre(2 * j, line.z[i] / beam.half_barrel);
  const Eigen::MatrixXd weighted      = line.share.asDiagonal() * P;
  Eigen::MatrixXd W                   = Eigen::MatrixXd::Zero(beam.M.rows(), n_barrel + 1);
  W.topLeftCorner(P.rows(), n_barrel) = weighted * (P.transpose() * weighted).inverse();
  W.col(n_barrel)                     = beam.seat;
  return W;
}
}  // namespace

Component beam_component(const std::string &name, const Roll &roll, const Material &steel, const int n_barrel,
                         const double limit, const int elements)
{
  const reduce::RollBody beam =
      reduce::beam_roll(name, roll, steel, elements, std::numeric_limits<double>::infinity());
  const Eigen::MatrixXd W = interface_functionals(beam, n_barrel);
  const Eigen::Index n = W.rows(), n_i = W.cols();
  const double scale       = beam.K.diagonal().maxCoeff();
  Eigen::MatrixXd bordered = Eigen::MatrixXd::Zero(n + n_i, n + n_i), right = Eigen::MatrixXd::Zero(n + n_i, n_i);
  bordered.topLeftCorner(n, n)        = beam.K;
  bordered.topRightCorner(n, n_i)     = scale * W;
  bordered.bottomLeftCorner(n_i, n)   = scale * W.transpose();
  right.bottomRows(n_i)               = scale * Eigen::MatrixXd::Identity(n_i, n_i);
  const Eigen::MatrixXd static_shapes = bordered.partialPivLu().solve(right).topRows(n);

  // Motions that the interface does not see.
  const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(W).householderQ();
  const Eigen::MatrixXd Z = Q.rightCols(n - n_i), K_z = Z.transpose() * beam.K * Z;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> held(K_z, Z.transpose() * beam.M * Z);
  const Eigen::VectorXd f     = held.eigenvalues().cwiseSqrt() / (2 * M_PI);
  const Eigen::Index n_m      = std::upper_bound(f.begin(), f.end(), limit) - f.begin();
  const Eigen::MatrixXd modes = Z * held.eigenvectors().leftCols(n_m);

  Component c;
  c.name   = name;
  c.source = "Timoshenko beam";
  for (int j = 0; j < n_barrel; ++j)
    c.interface.push_back("barrel P" + std::to_string(2 * j));
  c.interface.push_back("seat");
  c.n_barrel    = n_barrel;
  c.half_barrel = beam.half_barrel;
  Eigen::MatrixXd basis(n, n_i + n_m);
  basis << static_shapes, modes;
  c.M                         = basis.transpose() * beam.M * basis;
  c.K                         = Eigen::MatrixXd::Zero(n_i + n_m, n_i + n_m);
  c.K.topLeftCorner(n_i, n_i) = static_shapes.transpose() * beam.K * static_shapes;
  c.K.diagonal().tail(n_m)    = held.eigenvalues().head(n_m);
  c.fixed_frequency           = f.head(n_m);
  const Eigen::MatrixXd load  = held.eigenvectors().transpose() * Z.transpose() * beam.M * static_shapes;
  const Eigen::Index left_out = f.size() - n_m;
  c.residual                  = load.bottomRows(left_out).transpose() *
               held.eigenvalues().tail(left_out).cwiseInverse().asDiagonal() * load.bottomRows(left_out);
  c.axis_z = beam.axis_z;
  c.axis   = basis;
  c.mass   = beam.M.diagonal().sum();
  return c;
}
}  // namespace mill::verify
