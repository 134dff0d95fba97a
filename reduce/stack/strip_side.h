#pragma once
#include "reduce/stack/roll_group.h"
#include "reduce/stack/strip_flattening.h"

namespace mill::reduce {
/// One work roll at the strip: how the gap on its side follows from the deflection of its group and the line
/// loads. The opening of the gap is the sum of both sides.  theory.md (51.2)
class StripSide {
public:
  /// @param sign  +1: the strip pushes this roll up
  StripSide(const Stack &stack, RollGroup &group, std::size_t roll, double sign, Eigen::VectorXd edges,
            Flattening law);

  RollGroup &group;
  std::vector<UnknownRow> rows;  ///< of each element: integral of the opening that the axis adds, m2
  Eigen::MatrixXd flattening;    ///< (n, n) 1/Pa
  Eigen::VectorXd ground;        ///< (n) m, mean radius departure of each element

  /// (n, n) m/(N/m) by the axis alone: B K^-1 B^T; keeps L^-1 B^T for back().
  const Eigen::MatrixXd &flexibility();
  /// K^-1 (r + B^T q).
  Eigen::VectorXd respond(const Eigen::VectorXd &residual, const Eigen::VectorXd &q) const;
  Eigen::VectorXd integrals(const Eigen::VectorXd &u) const;  ///< B u, (n) m2
  /// What this side adds to the mean opening from z1 to z2 (m, from the middle of the strip).
  double opening(const Eigen::VectorXd &u, const Eigen::VectorXd &q, double z1, double z2, bool with_ground) const;

  std::size_t work_roll() const
  {
    return roll;
  }

private:
  const Stack &stack;
  std::size_t roll;
  double sign;
  FlattenedRoll flattened;
  Eigen::MatrixXd by_axis;
};
}  // namespace mill::reduce
