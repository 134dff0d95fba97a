#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace mill::fmu {
/// A recorded bite force, straight lines between its samples; constant before the first and after the last.
struct ForceSeries {
  std::vector<double> time;   ///< (k) s, increasing
  std::vector<double> force;  ///< (k) N

  /// Number of samples at or before a time (s).  `hint`, what an earlier call gave, makes it quick.
  std::size_t before(double t, std::size_t hint) const;
  /// N at a time (s) behind `n` samples.
  double at(double t, std::size_t n) const;
};

/// Text of resources/force.csv: a header, then "time,force" in s and N.
/// @throws std::runtime_error  a line that is not a sample, times that do not increase, no samples
ForceSeries read_series(const std::string &csv);
}  // namespace mill::fmu
