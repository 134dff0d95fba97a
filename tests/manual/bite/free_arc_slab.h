#pragma once
#include "reduce/bite/bite.h"

// A slab with elastic ends between rolls of any shape, by relaxation on even points: shares neither discretisation
// nor solver with reduce/bite/slab/elastic_arc or with the finite elements.
namespace mill::verify {
struct FreeArcSlab {
  double force     = 0;  ///< N/m
  double exit      = 0;  ///< m, end of the contact behind the line of centres
  double entry     = 0;  ///< m, where the strip meets the roll, before it
  double peak      = 0;  ///< Pa
  double exit_gain = 0;  ///< Pa, stress along the strip at the thinnest place over the front tension
  int passes       = 0;  ///< of the relaxation
};

/// Coulomb friction without limit, parabola and half plane, the strip's modulus in plane strain.
/// @param points   even, over the range of reference of the relaxation, -0.8 .. 2.4 sqrt(R dh)
/// @param coupled  friction and thinning change the stress along the strip in the elastic ends too, (19.16);
/// false:
///                 that stress stays the tension there, (17.12)
/// @throws SolverError  not at rest after 20000 passes
/// Cost: points^2 a pass, some hundreds of passes: 0.3 s for 800 points.
FreeArcSlab slab_on_free_arc(const bite::RollBite &bite, int points, bool coupled);
}  // namespace mill::verify
