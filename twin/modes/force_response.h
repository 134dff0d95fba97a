#pragma once
#include "twin/modes/decimated.h"
#include "twin/spectra/fourier.h"
#include <Eigen/Core>

// What the recorded force does to each channel.  Chapter 42.3.
namespace mill::twin {
/// Frequency response by the estimator H1 and the share of each channel that follows the force.
struct ForceResponse {
  double rate    = 0;         ///< Hz, of the samples behind it
  Eigen::Index L = 0;         ///< samples of a segment, a power of two; periodic Hann window, overlap by half
  Eigen::Index n = 0;         ///< segments; 0: no piece is long enough
  Eigen::VectorXd force;      ///< (k) N^2/Hz, density of the force at bins 0, 1, ..
  Eigen::MatrixXcd H;         ///< (k, p) unit of the channel per N, S_yF / S_FF.  theory.md (42.8)
  Eigen::MatrixXd coherence;  ///< (k, p) -, what n segments give by chance taken off, 0 .. 1.  theory.md (42.9)
  double resolution() const;  ///< Hz, distance of two bins
  double length() const;      ///< s, of a segment
};

/// @param record   rows: channels, then the force last
/// @param highest  Hz, bins above it are left out
/// @param L        0: default_segment(), at most 10 s
/// Cost (p + 1) transforms of each segment.
ForceResponse force_response(const DecimatedRecord &record, double highest, Eigen::Index L, Fourier &fourier);
}  // namespace mill::twin
