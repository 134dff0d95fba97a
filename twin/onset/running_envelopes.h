#pragma once
#include "twin/onset/envelope.h"
#include <cstdint>
#include <functional>

namespace mill::twin {
/// Envelopes of several bands of several channels as the samples come, value for value those of
/// complex_envelope().  theory.md (41.12)
class RunningEnvelopes {
public:
  /// @param rate       Hz
  /// @param frequency  (m) Hz, of the bands
  RunningEnvelopes(double rate, Eigen::Index channels, const Eigen::VectorXd &frequency);

  /// @param time  s from sample 0, middle of the filter
  /// @param z     (m, channels) 0-peak; NaN where a sample below the filter is missing
  using Value = std::function<void(double time, const Eigen::MatrixXcd &z)>;

  /// @param first    number of the first sample; other than the one after the last begins a new piece
  /// @param samples  (n, channels), NaN: missing
  /// Cost: one product of the length of the filter for each value, channel and band.
  void take(std::int64_t first, const Eigen::MatrixXd &samples, const Value &value);
  void restart();
  double rate() const;  ///< 1/s, of the values

private:
  double sample_rate;
  std::vector<EnvelopeFilter> filters;
  Eigen::MatrixXd taps;             // (n, 2 m)
  Eigen::MatrixXd buffer;           // (capacity, channels), the last samples
  Eigen::Index begin = 0, end = 0;  // of what is still needed in the buffer
  std::int64_t number = -1;         // of the sample at `begin`; -1: none
};
}  // namespace mill::twin
