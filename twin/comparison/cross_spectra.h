#pragma once
#include "twin/spectra/fourier.h"
#include <Eigen/Core>
#include <vector>

namespace mill::twin {
struct Delay;
struct IncoherentShare;

/// Sums over n Hann segments of |X|^2, |Y|^2 and X conj(Y), X measured, Y simulated.
struct CrossSums {
  Eigen::ArrayXd xx, yy;  ///< (L/2 + 1)
  Eigen::ArrayXcd xy;     ///< (L/2 + 1)
  double n = 0;           ///< segments
  explicit CrossSums(Eigen::Index bins);
  void clear();
  void add(const CrossSums &other);
};

/// Independent segments that n half-overlapping Hann segments are worth.  theory.md (41.5)
double independent_segments(double n);

/// Largest cross-correlation within +-reach.
/// @param now   of the data whose delay is asked, @param known  of more data, for the coherence
/// @param duration  s, of the data of `now`
/// (50.2), (50.3).  Cost: one transform.
Delay delay_of(const CrossSums &now, const CrossSums &known, double rate, double duration, double reach,
               Fourier &fourier);

/// By third octaves with at least three bins, up to rate/2.56.  (50.4)
std::vector<IncoherentShare> incoherent_shares(const CrossSums &sums, double rate);
}  // namespace mill::twin
