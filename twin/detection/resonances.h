#pragma once
#include "twin/spectra/peaks.h"
#include "twin/spectra/welch.h"
#include <Eigen/Core>
#include <vector>

namespace mill::twin {
/// Broad peaks of a density from which lines were taken out: maxima of the density averaged over 1, 2, 4, .. bins
/// that stand out of the valleys to both sides by more than noise does.  theory.md (41.24)
/// @param density    (L/2 + 1) unit^2/Hz
/// @param low, high  Hz, where to look
std::vector<Peak> resonances(const WelchSpectrum &spectrum, const Eigen::VectorXd &density,
                             const Eigen::VectorXd &floor, double low, double high);
}  // namespace mill::twin
