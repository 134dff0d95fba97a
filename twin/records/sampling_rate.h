#pragma once
#include "twin/records/raw_record.h"
#include <string>
#include <vector>

namespace mill::twin {
/// What a named number says about the sampling rate.
enum class RateName {
  none,
  frequency,  ///< Fs, fs, sr, SampleRate, ..: samples per second
  step,       ///< dt, Ts, ..: seconds between two samples
  unclear     ///< rate: of turns, of rolling or of sampling
};
RateName rate_name(const std::string &name);

/// One number of a file that may be the sampling rate.
struct RateCandidate {
  std::string name;
  double number;  ///< as in the file
};

/// The sampling rate in Hz: by --rate, or else by all candidates together; NaN where there is none.
/// @param time_name  name of a vector of times, empty: none
/// @param time_rate  Hz, by its mean step
/// @throws InputError  candidates that disagree by more than 1e-3, with their names and values
double sampling_rate(const std::string &file, const std::vector<RateCandidate> &candidates,
                     const std::string &time_name, double time_rate, const ReadOptions &options,
                     std::vector<std::string> &notes);

/// Refuses a rate that no recorder has: below 1e-3 Hz, above 1e8 Hz, or not a number.
/// @throws InputError
void require_possible_rate(double rate, const std::string &source);
}  // namespace mill::twin
