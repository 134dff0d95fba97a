#pragma once
#include <Eigen/Core>

namespace mill::twin {
/// Natural cubic spline through (x, y) at x0, x0 + step, ..., n values; beyond the ends the end cubic goes on.
/// @param x  (m) increasing, m >= 2
/// Worked off in overlapping blocks: what lies 48 nodes away moves a value by less than 1e-26 of itself.
/// Cost O(m + n), no more memory than the result.
Eigen::VectorXd spline_on_grid(const Eigen::Ref<const Eigen::VectorXd> &x,
                               const Eigen::Ref<const Eigen::VectorXd> &y, double x0, double step, Eigen::Index n);
}  // namespace mill::twin
