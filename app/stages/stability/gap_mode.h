#pragma once
#include "dynamics/chatter/chatter.h"
#include <complex>
#include <string>

// The mode of a rolling stand that changes the gap.
namespace mill {
/// Of the modes with the strip as a spring: the one with the largest share in the static compliance of the gap.
struct GapMode {
  double frequency = 0;       ///< Hz
  double share     = 0;       ///< -, of the compliance of the gap
  std::complex<double> root;  ///< 1/s, of the stand with its bite: the eigenvalue that belongs to it
  double damping() const;     ///< -, of critical; negative: it grows
};
/// @param bite  coefficients at the speed of the pass
GapMode gap_mode(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite);

/// "gap mode at 107 Hz (third octave)": by what a root does to the gap and by its frequency.
std::string text_of_root(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite,
                         double frequency);
}  // namespace mill
