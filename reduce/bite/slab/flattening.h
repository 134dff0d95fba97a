#pragma once
#include "core/base/errors.h"
#include "reduce/bite/bite.h"
#include <functional>
#include <string>

// Hitchcock's flattened roll for any slab theory.  theory.md 8.4
namespace mill::bite {
/// R' over force: R' = R (1 + compliance F / (h_e - h_d)), (8.9).  In m/N, over the strip width.
double flattening_compliance(const RollBite &bite);

/// R' of (8.9) under a known force.  m
double hitchcock_radius(const RollBite &bite, double force);

/// True where R' has left the range in which the arc under the pressure is still close to a circle, R'/R above 5.
bool beyond_hitchcock(const RollBite &bite, double radius);

/// The sentence on it for the report.
Warning beyond_hitchcock_note(const RollBite &bite, double radius);

struct FlattenedArc {
  double radius   = 0;  ///< m, smallest R' that carries its own force
  double force    = 0;  ///< N, at that radius
  int evaluations = 0;  ///< of the force
};

/// No R' below 20 R carries its own force.
class NoFlattenedRadius : public SolverError {
  using SolverError::SolverError;
};

/// Smallest R' that satisfies R' = Phi(R') = R (1 + c F(R')/dh): the one the mill reaches when it loads up.
/// Plain iteration from R climbs to it and cannot pass it, because Phi rises; it is quickened by secants in
/// s = sqrt(R').  In s the function Phi/s - s is convex (8.14), so a chord drawn on beyond two points below the
/// root ends below it as well.  Convexity is watched on the way; where it fails, or a step lands beyond a root,
/// the step is taken back and the plain one made.
///
/// @param force_of_radius  N over the strip width on a rigid circular arc of that radius, rising with it; must
///                         return a number wherever the roll is asked for, also where no neutral point exists
/// @throws NoFlattenedRadius  no root below 20 R, with the R'/R reached
/// Cost: 5..9 evaluations, more only next to the largest force the roll can carry.
FlattenedArc flattened_arc(const RollBite &bite, const std::function<double(double)> &force_of_radius);

/// dF/dh_exit with the arc following the force, N/m, from the derivatives at a solved state, (8.11).
double following_slope(const RollBite &bite, double force, double by_exit, double by_radius);
}  // namespace mill::bite
