#pragma once
#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

// Frequency and damping of one mode from force and response of one block.  theory.md 50.4
namespace mill::twin {
/// Lines of a block's discrete Fourier transform, whole and without a window.
struct BlockSpectra {
  double duration = 0;        ///< s, T: line k is at k/T
  Eigen::VectorXcd force;     ///< (lines) N
  Eigen::MatrixXcd response;  ///< (lines, sensors)
};

/// What the twin says of a mode.
struct ExpectedMode {
  double frequency = 0;  ///< Hz
  double damping   = 0;  ///< -, ratio of critical
};

/// What a block says of it.
struct ModeFit {
  static constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  double frequency                = unknown;  ///< Hz
  double sd         = unknown;  ///< -, relative standard deviation of it, by the information of the block
  double damping    = unknown;  ///< -, ratio of critical
  double damping_sd = unknown;  ///< -, relative standard deviation of it
  double significance =
      0;                   ///< -, twice the logarithm of the likelihood that the mode gains: 60 and more is a mode
  Eigen::Index lines = 0;  ///< used
  std::string why_not;     ///< why it is not identified; empty: it is
};

/// The likelihood of theory.md 50.4 in the band of one mode: free are its frequency, its damping, its residues at
/// the sensors (complex, so that gains and a delay between two clocks do not count), its motion at both ends of
/// the block, together with straight lines over the band for the other modes and the ends.
/// @param expected  where to look: up to 5 half widths away, further when the minimum lies at the edge
/// @param others    modes that may lie in the same band; their frequencies are not changed
/// Cost: 1 ms for 700 lines and 4 sensors.
ModeFit fit_mode(const BlockSpectra &block, const ExpectedMode &expected, const std::vector<ExpectedMode> &others);
}  // namespace mill::twin
