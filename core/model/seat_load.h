#pragma once
#include "core/model/contact_settings.h"
#include "core/model/four_high.h"

namespace mill {
/// Radial load of one bearing of a stand and its parts.
struct SeatLoad {
  double value   = 0;      ///< N
  double bending = 0;      ///< N, of a chock; 0 where the load of the bearing is given
  double across  = 0;      ///< N, half of what the offset of the rolls pushes sideways, F e / (R1 + R2)
  bool given     = false;  ///< by bearing_load: nothing else is read
  bool assumed   = false;  ///< a twentieth of the rolling force stands for balance and bending
};

/// Vertical: half the rolling force and the bending on a bearing of a backup roll, the bending alone on that of a
/// work roll, and without bending a twentieth of the force.
/// @param backup   a bearing of the backup roll; false: of the work roll
/// @param contact  of the two rolls, with their offset
/// @param force    N, rolling force of the stand
SeatLoad seat_load(const FourHigh &stand, bool backup, const ContactSettings &contact, double force);
}  // namespace mill
