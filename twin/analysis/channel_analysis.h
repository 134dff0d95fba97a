#pragma once
#include "twin/analysis/analysis.h"

namespace mill::twin {
/// Spectra, map and peaks of one channel.
/// @param speed  (n) m/s; empty: not recorded
/// @param bands  whose rms is wanted
ChannelAnalysis analyse_channel(const CleanChannel &channel, double rate, const Eigen::VectorXd &speed,
                                const std::vector<ChatterBand> &bands);

/// Hz, band of the rms velocity: 10 to 1000 Hz, or to where a record of this rate ends.
struct VelocityBand {
  double low, high;  ///< Hz
  bool complete;     ///< the record reaches 1000 Hz
};
VelocityBand velocity_band(double rate);
/// Have the velocities of records of these rates one band?  Not where a rate is NaN.
bool have_one_band(double rate_a, double rate_b);

/// m/s, what the baseline has of a channel; NaN: nothing, or of another band.
double velocity_before(const Baseline &baseline, const std::string &channel, double rate);

/// Whether it is a vibration: an acceleration, a velocity, a voltage, or a quantity whose unit is not known.
bool is_vibration(Quantity quantity);
}  // namespace mill::twin
