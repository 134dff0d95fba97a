#include "core/records/stand_model.h"

namespace mill {
Eigen::MatrixXd symmetric_part(const Eigen::MatrixXd &m)
{
  return 0.5 * (m + m.transpose());
}

Eigen::MatrixXd stiffness_of(const StandModel &stand)
{
  Eigen::MatrixXd K = stand.K_parts;
  for (const Connection &c : stand.connections)
    K.noalias() += c.rows.transpose() * c.stiffness.asDiagonal() * c.rows;
  return K;
}

Eigen::MatrixXd dampers_of(const StandModel &stand)
{
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(stand.M.rows(), stand.M.rows());
  for (const Connection &c : stand.connections)
    if (c.damper > 0)
      C += c.damper * c.rows.transpose() * c.rows;
  return C;
}
}  // namespace mill
