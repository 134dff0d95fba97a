#pragma once
#include "twin/records/raw_record.h"
#include <Eigen/Core>
#include <vector>

namespace mill::twin {
/// Even grid found under the times of a record.  theory.md (41.1)
struct TimeGrid {
  double rate          = 0;            ///< Hz, slope of the line through the counter
  double offset        = 0;            ///< s, time of sample 0 of the grid on that line
  double jitter        = 0;            ///< s, root mean square distance of the times from the line
  Eigen::Index n       = 0;            ///< samples of the grid, missing ones counted
  Eigen::Index doubled = 0;            ///< samples with the time of their neighbour; left out
  bool uneven          = false;        ///< jitter of 0.02 samples and more: values have to be interpolated
  std::vector<Eigen::Index> position;  ///< (samples) of each sample on the grid, -1: left out; empty: 0, 1, 2, ..
};

/// s, median of the differences of the times.
double median_step(const RawRecord &record);

/// @throws InputError  more than 1 % of the times doubled, or jitter above half a sample
/// Cost O(n).
TimeGrid time_grid(const RawRecord &record);
}  // namespace mill::twin
