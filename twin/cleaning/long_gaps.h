#pragma once
#include "twin/records/raw_record.h"

namespace mill::twin {
/// A grid of more samples than this, most of them in gaps, would take more memory than the record: 256 MiB a
/// channel.
constexpr Eigen::Index largest_grid_of_gaps = Eigen::Index(1) << 25;
/// Samples that a gap keeps in such a grid.
constexpr Eigen::Index shortened_gap = Eigen::Index(1) << 20;

/// Shortens the long gaps of a record whose even grid would be mostly gaps: later times are moved by whole
/// samples, and a note of the record states by how much.  Other records stay as they are.
void shorten_long_gaps(RawRecord &record);
}  // namespace mill::twin
