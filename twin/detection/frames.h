#pragma once
#include "twin/spectra/welch.h"
#include <Eigen/Core>
#include <array>
#include <optional>
#include <vector>

namespace mill::twin {
/// One frequency from segment to segment of a Welch spectrum: what is steady is a line, what fades is a mode.
/// theory.md (41.22), (41.23)
struct FrameTest {
  Eigen::Index n   = 0;  ///< segments
  double frequency = 0;  ///< Hz, of the steady turn that fits all segments best
  double coherence = 0;  ///< -, share of the power that turns steadily; 1 of a line; noise is taken off
  double swing     = 0;  ///< -, variance of the powers over their mean squared; 0 of a line, 1 of a mode
  double deviation = 0;  ///< Hz, standard deviation of the frequency of a line in this noise
  double allowance = 0;  ///< -, what noise adds to the swing by chance
  bool steady() const;   ///< whether it is a line
};

/// @param k      bin of the peak
/// @param ratio  -, density of the bin over that of the noise next to it, > 1
/// Cost: one product of the length of the record.
FrameTest frame_test(const Eigen::VectorXd &value, const std::vector<Span> &pieces, const WelchSpectrum &spectrum,
                     Eigen::Index k, double ratio);

/// Two lines that lie so close that they make one peak of the spectrum, which beats.  theory.md (41.23a)
struct LinePair {
  struct Line {
    double frequency = 0, amplitude = 0, deviation = 0;  ///< Hz; of the channel, peak value; Hz
  };
  std::array<Line, 2> lines;  ///< by frequency
  double coherence = 0;       ///< -, share of the power that the two explain
};

/// Arguments and cost as of frame_test, and some 10^4 to 10^5 pairs of frequencies.  Of a record that is mostly
/// gaps the most segments in a row without a long gap are used.  Nothing where two lines do not explain the
/// segments, or where there are too few segments to see it.
std::optional<LinePair> line_pair(const Eigen::VectorXd &value, const std::vector<Span> &pieces,
                                  const WelchSpectrum &spectrum, Eigen::Index k, double ratio);
}  // namespace mill::twin
