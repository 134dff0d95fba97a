#pragma once
#include "twin/cleaning/clean_record.h"
#include <vector>

namespace mill::twin {
/// The channel with steady lines taken off, each with the amplitude and phase that fit every piece best, so that
/// modes and their growth are seen without them.  theory.md (41.28)
/// @param frequencies  Hz, strongest first
/// Cost: two products of the length of the record for each line.
Eigen::VectorXd without_lines(const CleanChannel &channel, double rate, const std::vector<double> &frequencies);
}  // namespace mill::twin
