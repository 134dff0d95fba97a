#pragma once
#include "reduce/bite/slab/slab_bite.h"

// What the fits of a pass ask of a closed theory: its force on an arc that is given.
namespace mill::bite {
/// Force on a circular arc of this radius (m), N over the strip width.  A neutral point outside the arc is taken
/// to its end, so that the force rises with flow stress and friction wherever it is asked for.
/// @param theory  bland_ford (Coulomb, speed or film law) or hu_ehmann (factors)
/// @throws InputError  another theory
/// Cost: 2 us
double force_on_arc(const RollBite &bite, Theory theory, double radius);

/// Radius of the arc under a force that is known, m: that of the roll, or Hitchcock's, (8.9).
/// @throws InputError  Arc::elastic, which is not a circle
double radius_under(const RollBite &bite, Arc arc, double force);
}  // namespace mill::bite
