#pragma once
#include <array>

namespace mill {
/// A band whose rms velocity is compared between analyses.
struct ComparedBand {
  const char *name;
  double low, high;  ///< Hz
};
constexpr std::array<ComparedBand, 3> compared_bands{
    {{"third-octave band", 125, 240}, {"fifth-octave band", 550, 650}, {"10 to 1000 Hz", 10, 1000}}};
}  // namespace mill
