#pragma once
#include "reduce/bite/bite.h"

// How far a bite is from skidding: from a neutral point that leaves the arc.
namespace mill::bite {
/// Friction of a bite over the least friction with which it has a neutral point, by Karman's slab on a circle;
/// below one the rolls skid.  Coulomb's coefficient or both factors are multiplied.
/// @param radius  m, of the arc
/// @param mu      -, Coulomb's coefficient; not used by a law of factors
/// @return  -, between 1e-3 and 1e3; at those ends a limit does not exist or no friction suffices
/// Cost: some 15 integrations along the arc, 1 ms.
double friction_margin(const RollBite &bite, double radius, double mu);
}  // namespace mill::bite
