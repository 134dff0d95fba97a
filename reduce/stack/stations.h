#pragma once
#include "core/model/stack.h"
#include <vector>

namespace mill::reduce {
/// Places along z that all rolls of a stack share, so that the elements of rolls that touch coincide.
struct Stations {
  std::vector<double> z;       ///< m, mill frame, increasing
  int place(double at) const;  ///< of the station there
  double length(int element) const
  {
    return z[std::size_t(element) + 1] - z[std::size_t(element)];
  }
};

/// Ends of sections, barrels, rings and strip, supports, loads; between them elements no longer than `longest`.
Stations stations_of(const Stack &stack, double longest);

/// Where two rolls may touch, mill frame: rings of b, else the common barrel.
std::vector<std::array<double, 2>> contact_zones(const Stack &stack, const StackContact &contact);

/// From the axis of a to that of b.
std::array<double, 2> direction_of(const Stack &stack, const StackContact &contact);

/// r of theory.md (51.1): how much larger the radius is at z (m, mill frame) than at mid-barrel.
double radius_departure(const StackRoll &roll, double z);
}  // namespace mill::reduce
