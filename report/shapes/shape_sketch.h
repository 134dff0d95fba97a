#pragma once
#include <string>

namespace mill::report {
/// A roll to scale along the axis of a diagram that stands above it.  A length that is NaN leaves its part out.
struct RollSketch {
  std::string title;
  bool work           = false;                 ///< work roll: lies on the backup roll, loaded by the strip
  double half_barrel  = 0;                     ///< m
  double radius       = 0;                     ///< m
  double neck_radius  = 0;                     ///< m
  double half_total   = 0;                     ///< m
  double half_contact = 0;                     ///< m, of the line where the rolls touch
  double half_seat    = 0;                     ///< m, half the distance of the bearing centres
  double half_strip   = 0;                     ///< m
  double width = 500, left = 60, right = 480;  ///< px, drawing and ends of the axis
  double low = -1, high = 1;                   ///< m, at those ends
};

/// Bearings as triangles, the contact line hatched, the load as arrows; empty without barrel, radius or ends.
std::string roll_sketch(const RollSketch &sketch);
}  // namespace mill::report
