#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mill::live {
/// Limits of one line of JSON.
struct LineLimits {
  std::size_t bytes    = 1 << 20;
  std::size_t channels = 64;
  std::size_t samples  = 8192;  ///< of a block
  int depth            = 3;
};
constexpr LineLimits line_limits{};

/// The content of one line of a source, before it is checked.
struct LineContent {
  bool is_head = false;                                             ///< has "millstand"
  std::optional<double> version, rate;                              ///< -, Hz
  std::string start, source, token;                                 ///< empty: none
  std::vector<std::pair<std::string, std::string>> units;           ///< channel, unit
  std::optional<double> s;                                          ///< number of the first sample
  std::vector<std::pair<std::string, std::vector<double>>> values;  ///< channel, samples; NaN: null
};

/// Takes a line of JSON apart, within the limits and without recursion.
/// @param problem  why it is refused, a sentence; left as it is when it is good
/// @return whether it is good; `content` holds what was read before the problem
bool read_line(std::string_view line, LineContent &content, std::string &problem);
}  // namespace mill::live
