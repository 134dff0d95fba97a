#pragma once
#include "twin/modes/response_fit.h"
#include "twin/modes/subspace.h"
#include <vector>

namespace mill::twin {
/// A mode that the response to the recorded force shows.
struct ForcedMode {
  double frequency, sd_frequency;  ///< Hz, standard deviation of the fit
  double damping, sd_damping;      ///< -, of critical
  Eigen::VectorXcd shape;          ///< (p) largest component 1
  Eigen::VectorXd sd_shape;        ///< (p) -, of its real and imaginary part each
  double coherence;                ///< -, at the mode, of the channel that moves most
  int orders;                      ///< of fifteen that show the pole
  bool confirmed;                  ///< both halves of the record show it
  FittedPole pole;                 ///< of the fit, residues in units of the channels
};

/// Modes of H1 and the response they were read from.
struct ForcedModes {
  ForceResponse response;         ///< n = 0: no force, or nothing follows it
  std::vector<ForcedMode> modes;  ///< ascending
  double best_coherence = 0;      ///< -, mean over the third octave and of the channel where it is largest; below
                                  ///< 0.3 nothing follows the force and no mode is looked for
};

/// Takes the confirmation from poles that a fit uses as background of sharp modes: the half-power band of one with
/// five times the damping holds a confirmed mode, or its fit reaches down to 0 Hz (a sixth of critical).
void drop_backgrounds(std::vector<ForcedMode> &modes);

/// Poles of the impulse responses (stable over half of the orders), each fitted to H1 in its band together with
/// its neighbours.  Confirmed: residue above five standard deviations in both halves of the record, frequencies
/// and dampings of the halves within six standard deviations of the whole, MAC 0.9.  theory.md (42.8) to (42.12)
/// @param channels  vibrations of one unit; @param force  of the same record
/// @param highest   Hz
/// @param of_response  modes of the response alone, tried too: one that the force hardly drives may stand out
/// there
ForcedModes forced_modes(const std::vector<const CleanChannel *> &channels, const CleanChannel &force, double rate,
                         double highest, const std::vector<IdentifiedMode> &of_response, int threads);
}  // namespace mill::twin
