#pragma once
#include "dynamics/cluster/stack.h"

// The stack at rest under the loads of a pass.  theory.md 38.3
namespace mill::cluster {
struct EquilibriumOptions {
  double step_cap = 2e-6;  ///< m, largest change of a displacement in one step
  int most_steps  = 400;
};

struct Equilibrium {
  Motion u;                           ///< m, from the unloaded centres
  std::vector<double> contact_loads;  ///< N, of every contact; zero: open
  double residual   = 0;              ///< N, largest on any roll
  int steps         = 0;
  double least_root = 0;  ///< 1/s2, smallest eigenvalue of M^-1 K; negative: the stack buckles
  bool stable() const
  {
    return least_root > 0;
  }
};

/// Displacements under the rolling force alone, from the approaches that belong to the forces in every contact on
/// the unloaded geometry; rolls behind rollers are left where they are.  Exact for a column.
/// @throws SolverError  a load that nothing takes up
Motion closed_form_approaches(const Stack &stack);

/// Rollers are set under load: their anchors follow the roll they press theirs against.  theory.md (38.10)
void set_rollers(Stack &stack, const Motion &start);

/// Damped Newton from closed-form approaches, or from `start` where that has the size of the stack.  A stack that
/// is coupled rolls without tangential force.
/// @param stack  anchors of its rollers are set
/// @throws SolverError  no convergence; names the roll with the largest residual force
/// Cost: some ten factorisations of the size of the stack.
Equilibrium equilibrium(const Stack &stack, const EquilibriumOptions &options = {}, const Motion &start = {});

/// set_rollers and equilibrium.
Equilibrium settle(Stack &stack, const EquilibriumOptions &options = {});
}  // namespace mill::cluster
