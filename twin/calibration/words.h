#pragma once
#include "twin/calibration/calibration.h"
#include <string>
#include <vector>

namespace mill::twin {
/// Directions of which a record knows less than half, weakest first, in words:
/// "0.47 ln K1 - 0.88 ln K2: only their series is seen".
/// @param stand  says which springs share a mass or a part
std::vector<std::string> unseen_directions(const Identification &identification, const FittedStand &stand);

/// An unknown as it is printed, with the digits that its interval allows: "+5.13 %"; of the delay "1.250 ms".
/// The value lies in the interval, since both belong to one problem.
struct ShownChange {
  std::string value, low, high;
};
/// @param written  the case is written: its value, with an interval that covers both this value with the other
///                 priors kept and the joint fit.  Otherwise the joint fit: value and interval.
ShownChange shown_change(const Calibrated &unknown, bool written);
/// What shown_change() formats.
struct ChangeInterval {
  double value, low, high;  ///< ln of the factor; s of a delay
};
ChangeInterval change_interval(const Calibrated &unknown, bool written);
/// Standard deviation that belongs to a value and its 95 % interval: of the side that reaches further.
double deviation_of(const ChangeInterval &change);

/// The method where no force was recorded, and the remedy where one was recorded under another name.
std::string without_force_words();

/// The weakest direction as a sum, whether or not the records show it.
std::string weakest_direction(const Identification &identification, const FittedStand &stand);
}  // namespace mill::twin
