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
/// Its root is the one whose motion agrees most with that mode (modal assurance with the masses).
/// @param bite  coefficients at the speed of the pass
/// @param K4    N/m, spring between the work rolls of the rolling state, so that the mode is mode.gap_first_kind
/// of
///              the run; NaN: the linear bite at constant tensions and friction
GapMode gap_mode(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite, double K4);

/// "gap mode at 107 Hz (third octave)": by what a root does to the gap and by its frequency; "motion without
/// vibration" where it dies away within a turn of its phase.
/// @param root  1/s, an eigenvalue of chatter_matrix(stand, bite)
std::string text_of_root(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite,
                         std::complex<double> root);

/// Of the vibrations that the gap sees (half a per cent of its compliance): the one with the least damping, of
/// critical.  Vibrations that the gap does not see keep their damping whatever the bite does.
struct LeastDamped {
  std::complex<double> root;  ///< 1/s; 0: the gap sees no vibration
  std::string sentence;       ///< "gap mode at 107 Hz"
};
LeastDamped least_damped(const dynamics::ChatterStandModel &stand, const bite::LinearCoefficients &bite);
}  // namespace mill
