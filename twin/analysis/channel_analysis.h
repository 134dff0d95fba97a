#pragma once
#include "twin/analysis/analysis.h"

namespace mill::twin {
/// Spectra, map and peaks of one channel.
/// @param speed  (n) m/s; empty: not recorded
/// @param bands  whose rms is wanted
ChannelAnalysis analyse_channel(const CleanChannel &channel, double rate, const Eigen::VectorXd &speed,
                                const std::vector<ChatterBand> &bands);

/// Is it a vibration: an acceleration, a velocity, a voltage or something nobody knows the unit of?
bool is_vibration(Quantity quantity);
}  // namespace mill::twin
