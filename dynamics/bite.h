#pragma once
#include "core/stand.h"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill::dynamics {
/// One pair of work rolls and the strip between them, steady: the gap does not move.
struct RollBite {
  Strip strip;
  double roll_radius = 0;  ///< m, work roll
  Material roll;           ///< for the flattening
  bool flattening = true;  ///< Hitchcock; false: rigid roll
};

/// The bite at rest.  x counts from the line of roll centres towards the entry.  theory.md 8
struct BiteState {
  double force             = 0;    ///< N, over the strip width, pushes the rolls apart
  double flattened_radius  = 0;    ///< m, R'
  double arc_length        = 0;    ///< m, x_e: from the line of centres to the entry, (8.2)
  double bite_angle        = 0;    ///< rad, arc length / flattened radius
  double neutral_position  = 0;    ///< m, x_n, (8.7)
  double neutral_thickness = 0;    ///< m
  double forward_slip      = 0;    ///< -, exit speed / roll speed - 1
  double peak_pressure     = 0;    ///< Pa, at the neutral point
  double entry_flow_stress = 0;    ///< Pa, plane strain
  double exit_flow_stress  = 0;    ///< Pa
  double largest_shear     = 0;    ///< -, largest friction stress over shear yield stress; above one: sticking
  int iterations           = 0;    ///< of the flattening
  Eigen::VectorXd position;        ///< (n) m, 0 .. x_e, the neutral point among them
  Eigen::VectorXd thickness;       ///< (n) m
  Eigen::VectorXd pressure;        ///< (n) Pa
  std::vector<std::string> notes;  ///< where the model leaves its range, one sentence each, for the report
};

/// Three stiffnesses that all go by the name K4, N/m over the strip width.  theory.md 8.5
struct BiteStiffness {
  double plastic_slope;            ///< -dF/dh_exit at fixed entry thickness and fixed R', (8.10)
  double plastic_slope_following;  ///< the same with R' following the force, (8.11)
  double flattening;               ///< elastic flattening of one roll on the strip, (8.12)
  double combined;                 ///< plastic slope (R' fixed) in series with both rolls, (8.13)
};

/// Plane-strain flow stress, Pa, at strain ln(h0/h), (8.1).
/// Laws: constant k | swift k (eps0 + e)^n | ludwik k0 + k e^n | voce k0 + k (1 - exp(-n e)) | power k e^n |
/// reduction-power k (eps0 + 1 - exp(-e))^n, with the reduction in place of the strain | table, linear in between
/// @throws InputError  unknown law, strain outside the table, fewer than two rows or falling strains in it
double flow_stress(const FlowStress &law, double strain);

/// Slab solution of Bland and Ford with strain hardening, tensions and constant Coulomb friction, and Hitchcock's
/// flattened roll.  Of several radii that satisfy the flattening the smallest is returned: it is the one the mill
/// reaches when it loads up.
///
/// @throws InputError   exit not thinner than entry; friction, width or radius not positive; tension at or
///                      above the flow stress; neutral point outside the arc (the strip is not pulled through,
///                      or skids), with the friction that would be needed
/// @throws SolverError  no flattened radius exists below 20 R: the rolls flatten faster than the gap closes
/// Cost: 96 pressure evaluations per flattening step, 5..40 steps; below 0.1 ms for a few steps.
/// Source: D. R. Bland, H. Ford, Proc. Inst. Mech. Eng. 159 (1948) 144; J. H. Hitchcock, ASME (1935), Roll neck
/// bearings.
BiteState solve_bite(const RollBite &bite);

/// Stiffnesses at a solved state.  The derivatives are exact (complex step), no difference quotient.
BiteStiffness bite_stiffness(const RollBite &bite, const BiteState &state);
}  // namespace mill::dynamics
