#pragma once
#include "core/model/stack.h"
#include "core/model/stack_statics.h"
#include <Eigen/Core>

namespace mill {
/// A bearing at one load.
struct BearingPoint {
  double approach = 0;  ///< m
  double tangent  = 0;  ///< N/m
};

/// @param load  N, >= 0; beyond both ends of the curve it goes on with the tangent there
BearingPoint bearing_point(const BearingCurve &curve, double load);

/// Forces of the two supports of a roll on it that balance what statics puts on the roll: (plane, support) N,
/// plane 0 along x, 1 along y.
Eigen::Matrix2d support_forces(const Stack &stack, std::size_t roll,
                               const std::vector<StackResultant> &resultants);

/// The stack with each support on a bearing as the spring that touches its curve at the load that statics puts on
/// it, (51.25), the housing in series.  Loads do not depend on the springs, so that nothing is iterated.
/// @throws std::logic_error  a bearing has no curve
Stack with_bearing_springs(Stack stack);
}  // namespace mill
