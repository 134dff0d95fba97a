#include "reduce/bite/schedule/deformation_power.h"
#include "core/base/errors.h"
#include <cmath>

namespace mill::bite {
DeformationPower deformation_power(const double flow_stress, const double width, const double speed,
                                   const double entry_thickness, const double exit_thickness,
                                   const double roll_radius)
{
  require_input(flow_stress > 0 && width > 0 && speed > 0 && roll_radius > 0,
                "power of deformation: flow stress, width, speed and roll radius must be positive");
  require_input(exit_thickness > 0 && entry_thickness > exit_thickness,
                "power of deformation: the exit thickness must be positive and below the entry thickness");
  DeformationPower of;
  of.power      = flow_stress * width * speed * exit_thickness * std::log(entry_thickness / exit_thickness);
  of.roll_force = of.power / (2 * speed);
  of.torque     = of.roll_force * roll_radius;
  return of;
}
}  // namespace mill::bite
