#pragma once
#include "twin/cleaning/clean_record.h"
#include "twin/spectra/fourier.h"
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace mill::twin {
/// One-sided density by Welch's method: periodic Hann window, segments overlapping by half, the mean of each taken
/// off.  theory.md (41.4)
struct WelchSpectrum {
  double rate    = 0;               ///< Hz, or 1/m of a record over the rolled length
  Eigen::Index L = 0;               ///< samples of a segment, a power of two
  Eigen::Index n = 0;               ///< segments
  Eigen::VectorXd density;          ///< (L/2 + 1) unit^2/Hz, 0 .. rate/2
  Eigen::VectorXd scatter;          ///< (L/2 + 1) -, standard deviation of the segments' powers over their mean
  double resolution() const;        ///< Hz, distance of two bins
  double enbw() const;              ///< Hz, equivalent noise bandwidth, 1.5 bins
  double dof() const;               ///< -, degrees of freedom of one bin
  double at(Eigen::Index k) const;  ///< Hz, of bin k
  /// -, factors on the density between which it lies with 95 % (chi-square).
  std::array<double, 2> band() const;
};

/// Longest power of two of which eight half-overlapping segments fit into n samples; 0: not even one of 2.
Eigen::Index default_segment(Eigen::Index n);

/// Segments lie whole inside the pieces.
/// @param L  power of two; 0: default_segment() of all pieces, no longer than 2^17 and than the longest piece
/// n = 0 segments where no piece is that long.  Cost O(n log L).
WelchSpectrum welch(const Eigen::VectorXd &value, const std::vector<Span> &pieces, double rate, Eigen::Index L,
                    Fourier &fourier);

/// A sinusoid between two bins: frequency and amplitude from the highest bin and its larger neighbour, exact for
/// one line under a Hann window.  theory.md (41.6)
struct SpectralLine {
  double frequency;      ///< Hz
  double amplitude;      ///< unit, 0-peak
  double amplitude_bin;  ///< unit, 0-peak, what the highest bin alone says
  double width;          ///< Hz, between the half-power points of the peak
};
/// @param k  a local maximum, 0 < k < L/2
SpectralLine line_at(const WelchSpectrum &spectrum, Eigen::Index k);

/// m/s, root mean square of the velocity between two frequencies, by division with i w where the channel is an
/// acceleration; NaN for others, and where the record ends below the band.  theory.md (41.7)
double velocity_rms(const WelchSpectrum &spectrum, Quantity quantity, double low = 10, double high = 1000);

/// Hz, where the noise floor has fallen by more than 30 dB within a fifth of the frequency and stays there up to
/// rate/2.56: what a filter or a sensor left; rate/2.56 where nothing falls.  A line does not move the floor.
double bandwidth(const WelchSpectrum &spectrum);
}  // namespace mill::twin
