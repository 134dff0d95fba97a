#pragma once
#include "twin/spectra/speed.h"

namespace mill::twin {
/// Relative standard error of the root mean square in a band, from how its level varies over the record:
/// half of that of the mean power of the frames, with the correlation of neighbouring frames.  (41.34)
/// @param low, high     Hz; at least the two bins around their middle
/// @param of_velocity   of an acceleration: power over (2 pi f)^2
/// @return -; NaN: fewer than eight frames, or no power
double level_error(const Waterfall &map, double low, double high, bool of_velocity = false);
}  // namespace mill::twin
