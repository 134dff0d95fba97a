#pragma once
#include "core/base/choice.h"
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mill {
/// A measured level of records.toml: one number of a pass, without its record.
struct MeasuredLevel {
  std::string place;                                        ///< "upper_work_roll"
  double rms   = std::numeric_limits<double>::quiet_NaN();  ///< m/s2; NaN: the peak was measured
  double peak  = std::numeric_limits<double>::quiet_NaN();  ///< m/s2, 0-peak; it follows the rms by its crest
  double error = 0.03;                                      ///< -, relative standard deviation
};

enum class RecordRole { fit, check };
constexpr auto words_of(RecordRole)
{
  return choice_words<RecordRole>("fit", "check");
}
/// How the force went between its samples.
enum class BetweenSamples {
  smooth,  ///< it has nothing above half the rate: a measured force
  lines    ///< straight lines: a force that a simulation was driven with, F sinc^2(f/rate)
};
constexpr auto words_of(BetweenSamples)
{
  return choice_words<BetweenSamples>("smooth", "lines");
}

/// One record of a folder.
struct RecordEntry {
  std::string file;                                        ///< path
  std::optional<RecordRole> role;                          ///< absent: the last third is the check
  double load = std::numeric_limits<double>::quiet_NaN();  ///< N, mean rolling force; NaN: that of the record
  BetweenSamples between = BetweenSamples::smooth;
  std::map<std::string, std::string> channels;  ///< plant's name -> place
};

/// The records of a folder as its records.toml describes them, or all of them where it has no such file.
struct RecordSet {
  std::string folder;
  std::vector<RecordEntry> entries;
  std::array<double, 2> band = {20, 900};  ///< Hz
  std::vector<MeasuredLevel> levels;
  double level_force     = std::numeric_limits<double>::quiet_NaN();  ///< N, rms of the force behind the levels
  double level_bandwidth = 1000;                                      ///< Hz, of that force
};
}  // namespace mill
