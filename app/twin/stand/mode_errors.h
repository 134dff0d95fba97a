#pragma once
#include <Eigen/Core>

namespace mill {
struct Case;

/// Relative error of each frequency as the last run of this very case states it: that of the mode within 2 % of
/// it.  NaN: the run states none, or there is no such run.
/// @param frequency  (n) Hz
/// @return (n) -
Eigen::VectorXd mode_errors_of_run(const Case &the_case, const Eigen::VectorXd &frequency);
}  // namespace mill
