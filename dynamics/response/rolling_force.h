#pragma once
#include "core/base/warning.h"
#include "core/records/records.h"
#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace mill::dynamics {
/// What a force record says about itself.
struct ForceStatistics {
  double mean;         ///< N, over the samples
  double smallest;     ///< N
  double largest;      ///< N
  double rms;          ///< N, of the deviation from the mean
  double duration;     ///< s
  double sample_rate;  ///< Hz, lines per second: (n - 1) / duration
  double bandwidth;    ///< Hz, sample_rate / 2: a record contains nothing above it
  double content;      ///< Hz, highest frequency whose power density is within 3 dB of the power-weighted mean
                       ///<     density; for white noise cut off at f this is f.  0 for a constant force
};

/// Statistics of a record of n >= 2 samples; uneven samples are read at the mean rate on the straight lines
/// between them for the spectrum.  Cost O(n log n).  theory.md (7.12)
ForceStatistics force_statistics(const ForceRecord &record);

/// One or two sentences when the record cannot excite the highest mode; empty when it can.
/// @param highest_mode  Hz
std::optional<Warning> bandwidth_warning(const ForceStatistics &statistics, double highest_mode);

/// A made force record.
struct NoiseSettings {
  std::array<double, 2> range;  ///< N, smallest and largest value, reached exactly
  double duration    = 10;      ///< s
  double bandwidth   = 1000;    ///< Hz, white from 0 to here and nothing above
  double rate        = 10e3;    ///< Hz, samples per second, at least twice the bandwidth
  std::uint64_t seed = 1;
};

/// Gaussian noise, white to the bandwidth, shifted and scaled so that its smallest and largest value are the
/// range: rate * duration + 1 samples from time 0.  The same seed gives the same record on every platform to
/// rounding: the deviates are made here from std::mt19937_64 and not by std::normal_distribution, which each
/// library does its way. Cost: one FFT.  theory.md (7.13)
/// @throws InputError  range not increasing, bandwidth not between 0 and rate/2, no two samples
ForceRecord synthetic_force(const NoiseSettings &settings);
}  // namespace mill::dynamics
