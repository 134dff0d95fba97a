#pragma once
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mill::twin {
/// What the JSON file next to arrays of numpy says of them.
struct NpySidecar {
  double rate = std::numeric_limits<double>::quiet_NaN();  ///< Hz
  std::string start;                                       ///< time of the first sample as text
  std::vector<std::pair<std::string, std::string>> units;  ///< channel, unit, in the order of the file
  std::string unit_of(const std::string &channel) const;   ///< "" where there is none
};

/// @param array  the file that it belongs to, for the message
/// @throws InputError  not there, not a JSON object, without units
NpySidecar npy_sidecar(const std::string &path, const std::string &array);
}  // namespace mill::twin
