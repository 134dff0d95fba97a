#pragma once
#include <Eigen/Core>

namespace mill::dynamics {
/// When the samples of a record were taken.
struct RecordTimes {
  Eigen::Index samples = 0;
  double duration      = 0;  ///< s, from the first sample to the last
  double step          = 0;  ///< s, median distance of two samples
  Eigen::Index n_gaps  = 0;  ///< distances above 1.5 medians
  double longest_gap   = 0;  ///< s
  double longest_at    = 0;  ///< s, where that begins
};

/// @param time  (n >= 2) s, increasing
/// Cost O(n).
RecordTimes record_times(const Eigen::VectorXd &time);
}  // namespace mill::dynamics
