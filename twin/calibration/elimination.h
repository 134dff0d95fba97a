#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>

namespace mill::twin {
/// Least squares for the transients from products of their columns.  A mode that no sensor sees gets none.
struct Elimination {
  Eigen::VectorXd scale;
  Eigen::LDLT<Eigen::MatrixXd> factor;
  explicit Elimination(const Eigen::MatrixXd &normal) : scale(normal.rows())
  {
    for (Eigen::Index i = 0; i < scale.size(); ++i)
      scale[i] = normal(i, i) > 0 ? 1 / std::sqrt(normal(i, i)) : 0;
    Eigen::MatrixXd scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    scaled.diagonal().array() += 1e-12;
    factor.compute(scaled);
  }
  Eigen::MatrixXd solve(const Eigen::MatrixXd &right) const
  {
    return scale.asDiagonal() * factor.solve(scale.asDiagonal() * right);
  }
};
}  // namespace mill::twin
