#pragma once
#include "fem/strip/common/strip_state.h"

// Steady plane-strain rolling of a rigid-plastic strip by finite elements.  theory.md 18
namespace mill::fem {
/// Regularisations and what the computation holds.
struct StripFlowModel {
  bite::Arc arc = bite::Arc::rigid;  ///< circle of the roll, Hitchcock's circle, or any shape
  double cutoff_strain_rate =
      1e-3;  ///< -, g0 over the mean rate of shear of the pass: below it the strip flows like a viscous liquid
  double cutoff_slip = 1e-3;  ///< -, d0 over the roll's speed: the sign of slip is regularised over it
  double tolerance   = 1e-9;  ///< -, norm of the scaled residual of a converged state; rounding stops it at 1e-10
  double exit_speed  = not_given;  ///< -, over the roll's; given: drawn at that speed, exit tension is a result
  bool release = true;  ///< the contact ends where the pressure has fallen to zero; false: on the line of centres
  bool follow_surface = true;  ///< false: contact begins at the geometric entry, mesh lines stay where they are
  bool derivatives    = true;  ///< by all inputs, two more factorisations
  double work_limit   = INFINITY;  ///< unknowns times factorisations, after which a solution is given up
};

/// Solves for velocity, pressure, roll pressure, surface, ends of contact and strain in one system of equations.
/// Friction: Coulomb with the limit Friction::shear_limit (nan: none), factor, speed and film law.
///
/// @param lines        of the mesh, which follow the strip: meshes::strip_lines
/// @param bite         rolls and strip
/// @param flexibility  of the roll's surface, Arc::elastic only; the exit thickness is then that of the strip
/// @param start        a state nearby, on any mesh, or null: cold start from a mesh with every fourth line
/// @throws InputError   what no roll can do with this strip; a flexibility that does not reach the ends of contact
/// @throws SolverError  no convergence: last converged level, residual, remedy
/// Cost: 48 x 12 elements: 12 factorisations of 12700 unknowns after some 30 of coarser grids, 2.5 s of one core
/// with derivatives; warm start less. Source: flow formulation: O. C. Zienkiewicz, P. C. Jain,
/// E. Onate, Int. J. Solids Struct. 14 (1978) 15.
StripFlow solve_strip_flow(const StripLines &lines, const bite::RollBite &bite, const StripFlowModel &model = {},
                           const bite::ArcFlexibility *flexibility = nullptr, const StripFlow *start = nullptr);
}  // namespace mill::fem
