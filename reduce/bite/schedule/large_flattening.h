#pragma once
#include "reduce/bite/slab/slab_bite.h"

// Flattening beyond the range of Hitchcock's formula, by the power that a public note puts in its place.
// theory.md 39.1
namespace mill::bite {
/// R'/R above which the power 2/3 replaces Hitchcock's line; both meet there.
constexpr double largest_of_hitchcock = 5.235;

/// R' under a force, m: Hitchcock's up to 5.235 R, 2 R (C F/(w dh))^(2/3) above, (39.1).
double flattened_radius_under(const RollBite &bite, double force);

/// Smallest R' that carries its own force by (39.1), and that force.
struct FlattenedPass {
  double radius = 0;  ///< m
  double force  = 0;  ///< N
};
/// @param theory  bland_ford or hu_ehmann
/// @throws SolverError  no such radius below 20 R
/// Cost: a plain iteration, 10 to 2000 forces of 2 us
FlattenedPass flattened_pass(const RollBite &bite, Theory theory);
}  // namespace mill::bite
