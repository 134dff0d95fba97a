#pragma once
#include "core/model/material.h"
#include "core/records/schedule_record.h"
#include <string>
#include <vector>

// Rolling force that follows a strip which vibrates between stand and coiler.  theory.md 39.5
namespace mill::bite {
/// What the dynamic force of a pass is made of.
struct DynamicPass {
  std::string name;
  double flow_stress     = not_given;  ///< Pa, plane strain, K
  double mean_tension    = not_given;  ///< Pa, of entry and exit
  double width           = not_given;  ///< m
  double radius          = not_given;  ///< m, of the arc: R, or R' where it is flattened
  double entry_thickness = not_given;  ///< m
  double exit_thickness  = not_given;  ///< m
  double exit_speed      = not_given;  ///< m/s
  double printed         = not_given;  ///< N, amplitude of the force to compare with; nan: none
};

/// dP_d/dy of one work roll that moves by y towards the strip, N/m: (K - s_m) w sqrt(R/dh), (39.9).
double force_per_displacement(const DynamicPass &pass);
/// Force of a displacement y (m), N, without linearising, (39.9).
double force_of_displacement(const DynamicPass &pass, double y);
/// The other way round, m.
double displacement_of_force(const DynamicPass &pass, double force);

/// The vibrating strip behind the stand, first or higher mode.
struct VibratingStrip {
  double span      = 0;  ///< m, stand to coiler
  double amplitude = 0;  ///< m, of the transverse vibration
  int mode         = 1;  ///< half waves
};
/// Constant of the strip at a circular frequency omega_k of the force (rad/s), m2/s, (39.8).
double strip_constant(const VibratingStrip &strip, double omega);
/// Natural circular frequency of the strip under a tension stress (Pa), rad/s.  @param density kg/m3
double strip_frequency(const VibratingStrip &strip, double tension, double density);

/// Constants and forces of a schedule.
/// @param in_fit  (passes) whose printed force the common constant is made from; the others are a blind test
/// @throws InputError  no pass to make the constant from, numbers that are not positive, a tension above the flow
///                     stress, with the name of the pass
DynamicForces dynamic_forces(const std::vector<DynamicPass> &passes, const std::vector<bool> &in_fit);
}  // namespace mill::bite
