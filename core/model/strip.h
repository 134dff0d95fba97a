#pragma once
#include "core/laws/flow_stress_law.h"
#include "core/laws/friction_law.h"
#include "core/model/material.h"

// The strip in the bite and what lies between it and the rolls.
namespace mill {
/// Strip in the bite.
struct Strip {
  double width             = 0;          ///< m
  double entry_thickness   = 0;          ///< m
  double exit_thickness    = 0;          ///< m
  double entry_tension     = 0;          ///< Pa, back tension, positive in tension
  double exit_tension      = 0;          ///< Pa, front tension
  double initial_thickness = not_given;  ///< m, reference of the strain; absent: entry thickness
  double youngs_modulus    = 210e9;      ///< Pa, elastic zones before and behind the bite
  double poisson_ratio     = 0.3;        ///< -
  FlowStress flow_stress;
  Friction friction;
};

template <class Io> void each_member(Io &&io, const Strip &record)
{
  const auto &[width, entry_thickness, exit_thickness, entry_tension, exit_tension, initial_thickness,
               youngs_modulus, poisson_ratio, flow_stress, friction] = record;
  io("width", width);
  io("entry_thickness", entry_thickness);
  io("exit_thickness", exit_thickness);
  io("entry_tension", entry_tension);
  io("exit_tension", exit_tension);
  io("initial_thickness", initial_thickness);
  io("youngs_modulus", youngs_modulus);
  io("poisson_ratio", poisson_ratio);
  io("flow_stress", flow_stress);
  io("friction", friction);
}
}  // namespace mill
