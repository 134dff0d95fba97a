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
}  // namespace mill
