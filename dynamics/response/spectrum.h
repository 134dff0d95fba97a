#pragma once
#include <Eigen/Core>

namespace mill::dynamics {
/// One-sided amplitude spectral density, mean of overlapping segments (Welch), Hann window.  theory.md (7.11)
struct Spectrum {
  Eigen::VectorXd frequency;    ///< (L/2 + 1) Hz, 0 .. rate/2
  Eigen::VectorXd density;      ///< (L/2 + 1) unit of the signal per sqrt(Hz)
  Eigen::Index segment_length;  ///< L, a power of two, samples
  Eigen::Index n_segments;      ///< overlapping by half
  const char *window = "Hann";
};

/// Spectrum of n evenly spaced samples; their mean is removed first.  The area under density^2 is the variance.
///
/// @param signal          (n) n >= 2
/// @param rate            Hz, samples per second
/// @param segment_length  0: the longest power of two of which eight fit into the signal, so that the scatter of a
///                        line is about a quarter of its power; a signal shorter than 2048 samples has fewer
///                        segments
/// Cost O(n log L).  Source: P. D. Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70-73.
Spectrum amplitude_spectral_density(const Eigen::VectorXd &signal, double rate, Eigen::Index segment_length = 0);
}  // namespace mill::dynamics
