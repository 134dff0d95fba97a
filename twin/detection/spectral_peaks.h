#pragma once
#include "core/records/finding_kind.h"
#include "twin/spectra/peaks.h"
#include "twin/spectra/welch.h"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill::twin {
/// A local maximum of a spectrum above the threshold, and what became of it.
struct SpectralCandidate {
  Peak peak;
  FindingKind fate;    ///< line, resonance, side_lobe, skirt or part_of_resonance until findings claim it
  std::string reason;  ///< one sentence
};

/// Lines and resonances of one channel.
struct SpectralPeaks {
  std::vector<SpectralCandidate> candidates;  ///< all, by fate
  Eigen::VectorXd floor;                      ///< (L/2 + 1) unit^2/Hz, noise_floor()
  Eigen::VectorXd without_lines;              ///< (L/2 + 1) unit^2/Hz, the density with the lines taken out
  double threshold = 0;                       ///< -, density over floor of the false-alarm probability
};

/// Lines above the threshold of a false-alarm probability of 1e-3 for the channel, then resonances in what the
/// lines leave.  theory.md 41.7
/// @param low, high  Hz, where to look
/// Cost: one product of the length of the record for each line.
SpectralPeaks spectral_peaks(const Eigen::VectorXd &value, const std::vector<Span> &pieces,
                             const WelchSpectrum &spectrum, double low, double high);
}  // namespace mill::twin
