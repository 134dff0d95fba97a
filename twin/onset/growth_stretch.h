#pragma once
#include "twin/onset/envelope.h"
#include <optional>

namespace mill::twin {
/// A part of a record in which the amplitude of a band grows exponentially.  theory.md (41.32), (41.33)
struct GrowthStretch {
  double from, to;   ///< s
  double sigma;      ///< 1/s, slope of the logarithm of the amplitude, > 0
  double deviation;  ///< 1/s, standard deviation by what the straight line leaves
  double gain;       ///< -, nepers from the first to the last value
  double level;      ///< 0-peak, at the end
};

/// The stretch of largest gain: a second and 1.2 nepers at least, a straight line in the logarithm, and an end
/// that a mode that noise drives reaches once in 1e7, and twice the largest value before; without enough before
/// it, 2.5 s of growth that is smoother than a rise of such a mode.  Cost O(m^2) of the quarters of a second.
std::optional<GrowthStretch> growth_stretch(const ComplexEnvelope &envelope);
}  // namespace mill::twin
