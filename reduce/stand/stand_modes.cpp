#include "reduce/stand/stand_modes.h"
#include "core/base/errors.h"
#include "core/numerics/mesh_pair.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
// Lowest eigenvalue relative to the largest below which a motion costs no energy: a stand of beams has 1e-7,
// rounding of a loose part leaves 1e-16.
constexpr double no_energy = 1e-12;

/// (parts): parts of y^T f that fall on each part.
Eigen::VectorXd by_part(const StandModel &stand, const Eigen::VectorXd &y, const Eigen::VectorXd &f)
{
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(Eigen::Index(stand.parts.size()));
  for (Eigen::Index i = 0; i < y.size(); ++i)
    sum[stand.part_of[std::size_t(i)]] += y[i] * f[i];
  return sum;
}

double largest_ratio(const StandModel &stand, const Eigen::MatrixXd &K)
{
  return (K.diagonal().array() / stand.M.diagonal().array()).maxCoeff();
}

[[noreturn]] void refuse_loose(const StandModel &stand, const Eigen::VectorXd &y)
{
  const Eigen::VectorXd E = by_part(stand, y, stand.M * y);
  Eigen::Index loose;
  E.maxCoeff(&loose);
  std::string with;
  for (Eigen::Index p = 0; p < E.size(); ++p)
    if (p != loose && E[p] > 0.02 * E.sum())
      with += (with.empty() ? ", together with the " : ", the ") + stand.parts[std::size_t(p)];
  throw InputError("stand model \"" + stand.name + "\": nothing holds the " + stand.parts[std::size_t(loose)] +
                   " in the vertical direction (y)" + with +
                   "; it can move without straining any spring. Join it to a part that is held, by a spring with "
                   "positive stiffness");
}

/// Modes of K and M, ascending; refuses a mass matrix that is not positive definite and a loose part.
Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> pencil(const StandModel &stand, const Eigen::MatrixXd &K)
{
  if (Eigen::LLT<Eigen::MatrixXd>(stand.M).info() != Eigen::Success || !(stand.M.diagonal().minCoeff() > 0))
    throw InputError("stand model \"" + stand.name + "\": its mass matrix is not positive definite");
  Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, stand.M);
  if (solver.eigenvalues()[0] < no_energy * largest_ratio(stand, K))
    refuse_loose(stand, solver.eigenvectors().col(0));
  return solver;
}

Eigen::LLT<Eigen::MatrixXd> factor(const StandModel &stand)
{
  const Eigen::MatrixXd K = stiffness_of(stand);
  Eigen::LLT<Eigen::MatrixXd> llt(K);
  // A loose part leaves a pivot of the size of rounding, of either sign; inverse iteration finds its motion.
  double lowest = 0;
  if (llt.info() == Eigen::Success) {
    Eigen::VectorXd y = Eigen::VectorXd::Ones(K.rows());
    for (int i = 0; i < 3; ++i)
      y = llt.solve(stand.M * y.normalized());
    lowest = y.dot(K * y) / y.dot(stand.M * y);
  }
  if (!(lowest > no_energy * largest_ratio(stand, K)))
    pencil(stand, K);
  return llt;
}
}  // namespace

StandModes stand_modes(const StandModel &stand, const double limit)
{
  const Eigen::MatrixXd K = stiffness_of(stand);
  const auto solver       = pencil(stand, K);
  const Eigen::VectorXd f = solver.eigenvalues().cwiseSqrt() / (2 * M_PI);
  const Eigen::Index m    = std::upper_bound(f.begin(), f.end(), limit) - f.begin();
  StandModes modes;
  modes.frequency        = f.head(m);
  modes.shape            = solver.eigenvectors().leftCols(m);
  const Eigen::Index n_p = Eigen::Index(stand.parts.size()), n_c = Eigen::Index(stand.connections.size());
  modes.kinetic.resize(n_p, m);
  modes.strain_of_part.resize(n_p, m);
  modes.strain.resize(n_c, m);
  modes.error_estimate         = Eigen::VectorXd::Constant(m, std::numeric_limits<double>::quiet_NaN());
  const Eigen::Index n_points  = std::min<Eigen::Index>(6, Eigen::Index(stand.points.size()));
  const Eigen::MatrixXd points = point_rows(stand, n_points) * modes.shape;
  for (Eigen::Index k = 0; k < m; ++k) {
    const double w2 = solver.eigenvalues()[k];
    if (n_points > 0) {
      Eigen::Index largest;
      points.col(k).cwiseAbs().maxCoeff(&largest);
      if (points(largest, k) < 0)
        modes.shape.col(k) *= -1;
    }
    const Eigen::VectorXd y     = modes.shape.col(k);
    modes.kinetic.col(k)        = by_part(stand, y, stand.M * y);             // (22.7)
    modes.strain_of_part.col(k) = by_part(stand, y, stand.K_parts * y) / w2;  // (22.8)
    for (Eigen::Index c = 0; c < n_c; ++c) {
      const Connection &spring = stand.connections[std::size_t(c)];
      modes.strain(c, k)       = spring.stiffness.dot((spring.rows * y).cwiseAbs2()) / w2;
    }
    if (stand.residual.rows() == y.size())
      modes.error_estimate[k] = w2 / 2 * y.dot(stand.residual * y);  // (22.9)
  }
  return modes;
}

void estimate_errors(StandModes &fine, const StandModes &coarse)
{
  for (Eigen::Index k = 0; k < std::min(fine.frequency.size(), coarse.frequency.size()); ++k)
    fine.error_estimate[k] = mesh_pair_error(fine.frequency[k], coarse.frequency[k], 4);
}

Eigen::MatrixXd static_solution(const StandModel &stand, const Eigen::MatrixXd &right)
{
  return factor(stand).solve(right);
}

Eigen::VectorXd static_displacement(const StandModel &stand)
{
  return static_solution(stand, stand.b);
}

Eigen::MatrixXd point_rows(const StandModel &stand, const Eigen::Index p)
{
  Eigen::MatrixXd rows(p, stand.M.rows());
  for (Eigen::Index i = 0; i < p; ++i)
    rows.row(i) = stand.points.at(std::size_t(i)).row;
  return rows;
}

StandModel without(StandModel stand, const std::string &connection)
{
  auto &all = stand.connections;
  all.erase(std::remove_if(all.begin(), all.end(), [&](const Connection &c) { return c.name == connection; }),
            all.end());
  return stand;
}
}  // namespace mill::reduce
