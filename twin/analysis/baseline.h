#pragma once
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace mill::twin {
/// Root mean square of a velocity in the band of velocity_band().
struct VelocityLevel {
  double value;  ///< m/s
  double rate;   ///< Hz, of the record; NaN: of several records with unlike bands
};

/// What earlier analyses of the same mill found.
struct Baseline {
  std::string folder, record;                         ///< folder and record of each, separated by commas
  std::map<std::string, VelocityLevel> velocity_rms;  ///< by channel
  std::map<std::tuple<std::string, std::string, std::string>, double>
      score;  ///< channel, bearing, family -> score of its harmonics
};

/// Reads analysis.json of a folder.
/// @throws InputError  there is no such file, or this program did not write it
Baseline read_baseline(const std::string &folder);

/// Several: root mean square of the velocities of each channel, and the highest score of each family, so that what
/// exceeds it exceeds all of them.
/// @param folders  one at least
Baseline read_baselines(const std::vector<std::string> &folders);
}  // namespace mill::twin
