#pragma once
#include "twin/calibration/calibration.h"
#include <string>
#include <vector>

namespace mill::twin {
/// Directions of which a record knows less than half, weakest first, in words:
/// "0.47 ln K1 - 0.88 ln K2: only their series is seen".
/// @param stand  says which springs share a mass or a part
std::vector<std::string> unseen_directions(const Told &told, const FittedStand &stand);

/// An unknown as it is printed, with the digits that its interval is worth: "+5.13 %"; of the delay "1.250 ms".
struct ShownChange {
  std::string kept, estimate, low, high;
};
ShownChange shown_change(const Calibrated &unknown);

/// What is done where no force was recorded, and the remedy where one was under another name.
std::string without_force_words();

/// The weakest direction, whether or not it is seen, as a sum alone.
std::string weakest_direction(const Told &told, const FittedStand &stand);
}  // namespace mill::twin
