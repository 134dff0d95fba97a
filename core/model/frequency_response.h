#pragma once
#include "core/model/material.h"
#include <array>

namespace mill {
/// Of one frequency response.
inline constexpr double most_frequencies = 20000;

/// [frequency_response]: at which frequencies the stand answers a harmonic force.
struct FrequencyResponseSettings {
  std::array<double, 2> range = {not_given, not_given};  ///< Hz; absent: by the modes
  double resolution           = not_given;               ///< Hz; absent: by the width of the resonances
  double damping_tolerance    = not_given;               ///< -, how far the modal damping may be off
};
}  // namespace mill
