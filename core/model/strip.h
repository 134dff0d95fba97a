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
}  // namespace mill
