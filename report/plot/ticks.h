#pragma once
#include <string>
#include <vector>

namespace mill::report {
/// Where an axis is marked and what is written there.
struct Ticks {
  std::vector<double> at;           ///< increasing, inside [low, high]
  std::vector<std::string> labels;  ///< as many as `at`
  std::vector<double> minor;        ///< grid lines without a label (logarithmic axes)
};

/// Multiples of 1, 2 or 5 times a power of ten inside [low, high], about `wanted` of them, never more than twice
/// as many; labels with just the decimals the step needs.  Requires low < high.
/// Source: P. S. Heckbert, Nice numbers for graph labels, Graphics Gems (1990).
Ticks linear_ticks(double low, double high, int wanted);

/// Powers of ten inside [low, high]; below two decades also 2 and 5 times a power of ten, above `wanted` decades
/// only every second, third, ... power is labelled.  Requires 0 < low < high.
Ticks log_ticks(double low, double high, int wanted);
}  // namespace mill::report
