#pragma once
#include "reduce/bite/bite.h"
#include "reduce/bite/slab/slab_bite.h"
#include <string>

// The roll bite by horizontal equilibrium integrated from both ends: homogeneous (Karman) and inhomogeneous
// (Orowan).
namespace mill::bite {
/// How the integrated theories are solved.
struct KarmanOptions {
  /// Parabola in place of the circle, no friction share in the force and no angle in Orowan's pressure: the
  /// equations of Bland and Ford and of Sims without their further steps.
  bool small_angles = false;
  bool derivatives =
      true;  ///< force_by, torque_by and the following arc; without them a state takes a third of the time
  int points       = 200;    ///< of the plots along the arc; 0: none
  double tolerance = 1e-11;  ///< -, of the integration and of the iterations, relative
  int arc_points   = 200;    ///< of the pressure on an elastic arc, about
};

/// State of a bite by the horizontal equilibrium of slices, integrated from entry and exit to where both branches
/// give the same horizontal force.  theory.md 17
///   Theory::karman  pressure even through the thickness, p = f/h + k
///   Theory::orowan  pressure of a wedge of plastic material between inclined plates
///   Theory::sims    orowan with friction at the shear yield stress all along and small angles, in closed form
/// Friction: Coulomb with the limit Friction::shear_limit (nan: none), factor, speed and film law.
/// Arc: rigid and Hitchcock's circle; elastic shapes with Theory::karman only, by elastic_arc.h.
///
/// @param flexibility  of the roll's surface, Arc::elastic only; nullptr: half plane
/// @throws InputError   no neutral point in the arc, with the friction that would be needed; tension above the
/// flow
///                      stress; exit not thinner than entry; a moving gap; Sims below mu = 0.25
/// @throws SolverError  no flattened radius; iteration of the film or of the elastic arc not settled
/// Cost: homogeneous 0.2 ms with derivatives on a given arc, inhomogeneous 0.5 ms, flattening about as much again;
/// the film law several times that.  Source: Th. von Karman, ZAMM 5 (1925) 139; E. Orowan, Proc. Inst. Mech. Eng.
/// 150 (1943) 140.
BiteState solve_karman(const RollBite &bite, Theory theory, Arc arc, const ArcFlexibility *flexibility = nullptr);
BiteState solve_karman(const RollBite &bite, Theory theory, Arc arc, const ArcFlexibility *flexibility,
                       const KarmanOptions &options);

/// A strip drawn by its front tension between idle rolls without friction.
struct IdleDrawing {
  double exit_tension;  ///< Pa, needed to draw the strip through
  double force;         ///< N, over the strip width
};

/// Frictionless drawing: a single branch from entry to exit; the bite's friction and exit tension are not used.
/// A lower bound of the tension of any plastic solution (it holds the homogeneous work only).  (17.8)
IdleDrawing draw_through_idle_rolls(const RollBite &bite, const KarmanOptions &options = {});
}  // namespace mill::bite
