#pragma once
#include "dynamics/response/spectrum.h"
#include <vector>

namespace mill::dynamics {
/// amplitude_spectral_density() of a signal that arrives piece by piece; memory: one segment.  theory.md (7.11)
class RunningSpectrum {
public:
  /// @param segment_length  a power of two, at least 2
  /// @param mean            taken from every sample; of a whole record it is known after a first pass
  RunningSpectrum(double rate, Eigen::Index segment_length, double mean = 0);
  void add(double sample);
  /// Of the segments that are full; without any of them n_segments is 0 and the density is zero.
  Spectrum spectrum() const;

private:
  double rate_, mean_;
  Eigen::ArrayXd window_;
  std::vector<double> samples_;
  Eigen::ArrayXd power_;
  Eigen::Index n_segments_ = 0;
};

/// The length that amplitude_spectral_density() takes for n samples, at most `most`.
Eigen::Index segment_length_for(Eigen::Index n, Eigen::Index most);
}  // namespace mill::dynamics
