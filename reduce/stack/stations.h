#pragma once
#include "core/model/stack.h"
#include <vector>

namespace mill::reduce {
/// Places along z that all rolls of a stack share, so that the elements of rolls that touch coincide.
struct Stations {
  std::vector<double> z;             ///< m, mill frame, increasing
  int place(double position) const;  ///< of the station there
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

/// Whether a contact has a part along x, so that rolls move in both planes.
bool has_inclined_contact(const Stack &stack);

/// Rolls that touch, directly or by others.
std::vector<std::vector<std::size_t>> touching_groups(const Stack &stack);

/// H of theory.md (51.5) at z (m, from the middle of the strip) as the case gives it.
double entry_departure(const StackStrip &strip, double z);
/// Slopes of (51.5), Pa: of the line load over the exit thickness, with its sign changed, and over the entry
/// thickness.
double opening_factor(const StackStrip &strip);
double entry_factor(const StackStrip &strip);

/// r of theory.md (51.1): how much larger the radius is at z (m, mill frame) than at mid-barrel.
double radius_departure(const StackRoll &roll, double z);
}  // namespace mill::reduce
