#pragma once
#include "reduce/bite/bite.h"
#include "reduce/bite/slab/karman.h"

// Rolls whose arc takes any shape under the pressure: thin hard strip.  theory.md 17.6
namespace mill::bite {
/// Homogeneous slab theory on an arc of any shape, with elastic loading before and elastic unloading behind the
/// plastic strip.  All pressures at once by Newton's method, exact tangent; where that fails from the rigid arc
/// the compliance of the roll is raised in steps.
///
/// `exit_position` and `arc_length` are the ends of the plastic arc; `position` also spans the elastic zones,
/// whose pressure is part of the force.  `flattened_radius` is that of the circle through both ends of the plastic
/// arc. The derivatives hold the displacement of the roll's surface; force_by_exit_following lets it follow.
///
/// @param flexibility  of the roll's surface over at least the contact; nullptr: half plane, (17.13).  Between its
///                     points the difference from the half plane is interpolated, so that the points of the
///                     pressure can stand closer at the ends of the contact.
/// @param options      arc_points: about as many points of the pressure; small_angles is always so here
/// @throws InputError   strip without an elastic modulus: its elastic zones are compulsory; what karman.h throws
/// @throws SolverError  not converged, with the share of the compliance that was; the arc becomes parallel (foil);
///                      surface not given far enough
/// Cost: 0.1 s with 200 points.
/// Source: M. J. Jortner, J. F. Osterle, C. F. Zorowski, Int. J. Mech. Sci. 2 (1960) 179 (influence functions).
BiteState solve_elastic_arc(const RollBite &bite, const ArcFlexibility *flexibility,
                            const KarmanOptions &options = {});
}  // namespace mill::bite
