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

/// Mass matrix with the rows of one part alone; parts share no mass.
Eigen::MatrixXd mass_of_part(const StandModel &stand, const int part)
{
  Eigen::MatrixXd M = stand.M;
  for (Eigen::Index i = 0; i < M.rows(); ++i)
    if (stand.part_of[std::size_t(i)] != part) {
      M.row(i).setZero();
      M.col(i).setZero();
    }
  return M;
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
  for (std::size_t part = 0; part < stand.parts.size(); ++part) {
    const Eigen::MatrixXd of_part = mass_of_part(stand, int(part));
    if (!of_part.isZero(0))
      reduced.masses.push_back({"mass " + stand.parts[part], V.transpose() * of_part * V});
  }
  reduced.kept = std::upper_bound(frequency.begin(), frequency.begin() + q, highest) - frequency.begin();
  return reduced;
}

dynamics::SlopedStand sloped_stand(const ReducedStand &stand, const Eigen::VectorXd &springs,
                                   const Eigen::VectorXd &masses, const Eigen::VectorXd &damping)
{
  require(springs.size() == Eigen::Index(stand.springs.size()), "one factor for each spring");
  require(masses.size() == Eigen::Index(stand.masses.size()), "one factor for each mass");
  require(damping.size() == stand.kept, "every mode needs a damping ratio");
  Eigen::MatrixXd K = stand.frequency.cwiseAbs2().asDiagonal();
  for (std::size_t s = 0; s < stand.springs.size(); ++s)
    if (springs[Eigen::Index(s)] != 1)
      K += (springs[Eigen::Index(s)] - 1) * stand.springs[s].stiffness;
  dynamics::SlopedStand slopes;
  Eigen::MatrixXd U;
  if ((masses.array() == 1).all()) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(K);
    U                = solver.eigenvectors().leftCols(stand.kept);
    slopes.frequency = solver.eigenvalues().head(stand.kept).cwiseMax(0.0).cwiseSqrt();
  } else {
    Eigen::MatrixXd M = Eigen::MatrixXd::Identity(K.rows(), K.cols());
    for (std::size_t m = 0; m < stand.masses.size(); ++m)
      M += (masses[Eigen::Index(m)] - 1) * stand.masses[m].mass;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, M);
    U                = solver.eigenvectors().leftCols(stand.kept);
    slopes.frequency = solver.eigenvalues().head(stand.kept).cwiseMax(0.0).cwiseSqrt();
  }
  slopes.shape   = stand.point * U;
  slopes.damping = damping;
  slopes.force   = U.transpose() * stand.force;
  for (std::size_t s = 0; s < stand.springs.size(); ++s) {
    slopes.names.push_back(stand.springs[s].name);
    slopes.stiffness.push_back(springs[Eigen::Index(s)] * (U.transpose() * stand.springs[s].stiffness * U));
    slopes.mass.emplace_back();
  }
  for (std::size_t m = 0; m < stand.masses.size(); ++m) {
    slopes.names.push_back(stand.masses[m].name);
    slopes.stiffness.emplace_back();
    slopes.mass.push_back(masses[Eigen::Index(m)] * (U.transpose() * stand.masses[m].mass * U));
  }
  return slopes;
}
}  // namespace mill::twin
