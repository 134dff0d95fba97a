#include "core/model/seat_load.h"
#include <cmath>

namespace mill {
SeatLoad seat_load(const FourHigh &stand, const bool backup, const ContactSettings &contact, const double force)
{
  const Roll &roll = backup ? stand.backup_roll : stand.work_roll;
  SeatLoad load;
  load.given = !std::isnan(roll.bearing_load);
  load.value = roll.bearing_load;
  if (load.given)
    return load;
  const double between  = (stand.work_roll.barrel_diameter + stand.backup_roll.barrel_diameter) / 2;
  load.across           = 0.5 * force * std::abs(contact.axis_offset) / between;
  load.bending          = 0.5 * std::abs(stand.work_roll.bending_force[0] + stand.work_roll.bending_force[1]);
  load.assumed          = !backup && load.bending == 0;
  const double vertical = backup ? (force + 2 * load.bending) / 2 : load.assumed ? force / 20 : load.bending;
  load.value            = std::hypot(vertical, load.across);
  return load;
}
}  // namespace mill
