#pragma once
#include "core/model/four_high.h"
#include "core/model/frame.h"
#include "core/model/roll.h"

// In a header, so that tests have it in a build without finite elements too.
namespace mill::verify {
/// The demo stand of the acceptance cases: drawing, masses and frame springs (entry demo.inputs of the reference).
inline FourHigh demo_stand()
{
  FourHigh s;
  s.steel            = {2.1e11, 0.28, 7700};
  Roll &w            = s.work_roll;
  w.barrel_diameter  = 0.42;
  w.barrel_length    = 1.4;
  w.neck_diameter    = 0.2667;
  w.neck_length      = 0.46;
  w.bearing_span     = 2;
  w.bearing_mass     = 90;
  w.chock_mass_upper = 0;
  w.chock_mass_lower = 880;
  Roll &b            = s.backup_roll;
  b.barrel_diameter  = 1.45;
  b.barrel_length    = 1.4;
  b.neck_diameter    = 0.95;
  b.neck_length      = 0.95;
  b.bearing_span     = 2.45;
  b.bearing_mass     = 1500;
  b.chock_mass_upper = 10900;
  b.chock_mass_lower = 9800;
  Frame &f           = s.frame;
  f.upper_post_mass = 5200, f.upper_beam_mass = 2700, f.upper_packing_mass = 420, f.piston_mass = 1000;
  f.cylinder_mass = 7400, f.balance_mass = 8000;
  f.lower_post_mass = 2150, f.lower_beam_mass = 1850, f.load_cell_mass = 240, f.lower_packing_mass = 420;
  f.upper_post_stiffness = 6e10, f.upper_beam_stiffness = 7.3e9, f.piston_stiffness = 4e11;
  f.upper_packing_stiffness = 4.5e11, f.oil_column_stiffness = 1.8e10, f.cylinder_body_stiffness = 1.25e11;
  f.upper_chock_stiffness = 1.03e11, f.lower_chock_stiffness = 1.03e11;
  f.lower_post_stiffness = 6e10, f.lower_beam_stiffness = 8.05e9, f.lower_packing_stiffness = 2.25e11;
  s.strip.width = 1;
  return s;
}
}  // namespace mill::verify
