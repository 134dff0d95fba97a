#pragma once
#include <Eigen/Core>
#include <vector>

namespace mill::report {
/// Samples that draw the same picture as all of them: of every column of the given width the first, the smallest,
/// the largest and the last, in their order.  No peak is lost, however many samples share a column.
///
/// @param x             (n) position, not decreasing; the column of a sample is floor(x / column_width)
/// @param y             (n) value; a NaN is never an extreme while its column holds a number
/// @param column_width  > 0, in the unit of x
/// @return              indices, increasing, at most four per column
/// Cost O(n).
std::vector<Eigen::Index> envelope(const Eigen::VectorXd &x, const Eigen::VectorXd &y, double column_width);

/// Two values per interval: the extremes of `n_intervals` equal runs of samples, in the order in which they occur.
/// All of a record when it has no more than 2 n_intervals samples.
///
/// @return (2 n_intervals) or (n)
Eigen::VectorXd interval_extremes(const Eigen::VectorXd &y, Eigen::Index n_intervals);
}  // namespace mill::report
