#pragma once
#include <string>
#include <vector>

namespace mill {
/// Flags that `millstand sweep` and `millstand study` share, as written.
struct SweepOptions {
  std::vector<std::string> vary;   ///< --vary "KEY=a,b,c", "KEY=lo..hi:n", "KEY~normal(5, 0.2) MN/mm"
  std::vector<std::string> watch;  ///< --watch, names of results; empty: the usual ones of the kind
  std::string model = "full";      ///< --model: quick or full
  std::string cache_limit;         ///< --cache-limit, "20GB"; empty: none
};
}  // namespace mill
