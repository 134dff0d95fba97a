#pragma once
#include <map>
#include <string>
#include <tuple>

namespace mill::twin {
/// What an earlier analysis of the same mill found.
struct Baseline {
  std::string folder, record;                  ///< where it stands, of which record
  std::map<std::string, double> velocity_rms;  ///< channel -> m/s
  std::map<std::tuple<std::string, std::string, std::string>, double>
      score;  ///< channel, bearing, family -> score of its harmonics
};

/// Reads analysis.json of a folder.
/// @throws InputError  no such file, or none of this program
Baseline read_baseline(const std::string &folder);
}  // namespace mill::twin
