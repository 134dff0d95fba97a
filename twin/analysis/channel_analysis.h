#pragma once
#include "twin/analysis/analysis.h"

namespace mill::twin {
/// Spectra, map and peaks of one channel.
/// @param speed  (n) m/s; empty: not recorded
/// @param bands  whose rms is wanted
ChannelAnalysis analyse_channel(const CleanChannel &channel, double rate, const Eigen::VectorXd &speed,
                                const std::vector<ChatterBand> &bands);

/// Whether it is a vibration: an acceleration, a velocity, a voltage, or a quantity whose unit is not known.
bool is_vibration(Quantity quantity);
}  // namespace mill::twin
