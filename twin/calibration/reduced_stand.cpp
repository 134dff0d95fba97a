#include "twin/calibration/reduced_stand.h"
#include "core/base/require.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr Eigen::Index most_modes = 64;

std::set<int> parts_of(const Connection &connection, const std::vector<int> &part_of)
{
  std::set<int> parts;
  for (Eigen::Index i = 0; i < connection.rows.cols(); ++i)
    if (!connection.rows.col(i).isZero(0))
      parts.insert(part_of[std::size_t(i)]);
  return parts;
}
}  // namespace

ReducedStand reduced_stand(const StandModel &stand, const Eigen::VectorXd &frequency, const Eigen::MatrixXd &shape,
                           const double highest)
{
  require(frequency.size() == shape.cols(), "every shape needs a frequency");
  const Eigen::Index q    = std::min(frequency.size(), most_modes);
  const Eigen::MatrixXd V = shape.leftCols(q);
  ReducedStand reduced;
  reduced.frequency = 2 * M_PI * frequency.head(q);
  reduced.force     = V.transpose() * stand.b;
  reduced.point.resize(Eigen::Index(stand.points.size()), q);
  for (std::size_t p = 0; p < stand.points.size(); ++p)
    reduced.point.row(Eigen::Index(p)) = stand.points[p].row.transpose() * V;
  for (const Connection &connection : stand.connections) {
    const Eigen::MatrixXd strain = connection.rows * V;
    reduced.springs.push_back({connection.name, strain.transpose() * connection.stiffness.asDiagonal() * strain,
                               parts_of(connection, stand.part_of)});
  }
  reduced.kept = std::upper_bound(frequency.begin(), frequency.begin() + q, highest) - frequency.begin();
  return reduced;
}

dynamics::SlopedStand sloped_stand(const ReducedStand &stand, const Eigen::VectorXd &factor,
                                   const Eigen::VectorXd &damping)
{
  require(factor.size() == Eigen::Index(stand.springs.size()), "one factor for each spring");
  require(damping.size() == stand.kept, "every mode needs a damping ratio");
  Eigen::MatrixXd K = stand.frequency.cwiseAbs2().asDiagonal();
  for (std::size_t s = 0; s < stand.springs.size(); ++s)
    if (factor[Eigen::Index(s)] != 1)
      K += (factor[Eigen::Index(s)] - 1) * stand.springs[s].stiffness;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(K);
  const Eigen::MatrixXd U = solver.eigenvectors().leftCols(stand.kept);
  dynamics::SlopedStand slopes;
  slopes.frequency = solver.eigenvalues().head(stand.kept).cwiseMax(0.0).cwiseSqrt();
  slopes.shape     = stand.point * U;
  slopes.damping   = damping;
  slopes.force     = U.transpose() * stand.force;
  for (std::size_t s = 0; s < stand.springs.size(); ++s) {
    slopes.names.push_back(stand.springs[s].name);
    slopes.stiffness.push_back(factor[Eigen::Index(s)] * (U.transpose() * stand.springs[s].stiffness * U));
    slopes.mass.emplace_back();
  }
  return slopes;
}
}  // namespace mill::twin
