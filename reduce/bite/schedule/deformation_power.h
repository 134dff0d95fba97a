#pragma once

namespace mill::bite {
/// Work of homogeneous deformation as a power and as what turns the rolls.  theory.md 39.4
struct DeformationPower {
  double power;       ///< W, both rolls, (39.6)
  double roll_force;  ///< N, at the surface of one roll, power / (2 v)
  double torque;      ///< N m, of one roll
};

/// k_f w v h_out ln(h_in/h_out): flow stress Pa (plane strain), width m, exit speed m/s, thicknesses m, roll
/// radius m. A lower bound: friction and redundant work come on top.
/// @throws InputError  a speed, stress, width or radius that is not positive, exit not thinner than entry
DeformationPower deformation_power(double flow_stress, double width, double speed, double entry_thickness,
                                   double exit_thickness, double roll_radius);
}  // namespace mill::bite
