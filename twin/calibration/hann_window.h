#pragma once
#include "twin/calibration/band_record.h"
#include <Eigen/Core>

// A model seen through the window of averaged spectra.  theory.md (44.7)
namespace mill::twin {
/// Quarter bins around those of an average, six bins beyond both ends, with a force of 1.
/// @param bin    rad/s, distance of two bins
/// @param first  the lowest bin, of `bins`
BandRecord fine_grid(double bin, Eigen::Index first, Eigen::Index bins);

/// |W|^2 of a periodic Hann window at the quarter bins around one bin, of sum 1.
Eigen::VectorXd hann_weights();

/// (bins) a column on the fine grid seen through the window.
Eigen::VectorXcd seen_through(const Eigen::VectorXcd &fine, const Eigen::VectorXd &weights, Eigen::Index bins);
}  // namespace mill::twin
