#pragma once
#include "reduce/bite/bite.h"

/// Pass of the demo stand between rigid rolls: 8 -> 5 mm, k 28 MPa, mu 0.2, 1 m wide, work roll 420 mm.
inline mill::bite::RollBite demo_pass()
{
  mill::bite::RollBite bite;
  bite.roll_radius                = 0.210;
  bite.roll                       = {2.1e11, 0.28, 7700};
  bite.strip.width                = 1.0;
  bite.strip.entry_thickness      = 8e-3;
  bite.strip.exit_thickness       = 5e-3;
  bite.strip.flow_stress.k        = 28e6;
  bite.strip.friction.coefficient = 0.2;
  return bite;
}
