#pragma once
#include <Eigen/Core>

// The film with a parabola along the bearing: one unknown at each angle.  Shares neither grid nor solver with
// film.h and is compared with it in every run.  theory.md (29.15)
namespace mill::bearing {
/// Force of a rigid, aligned film of constant viscosity without grooves, in the units of FilmReactions, along the
/// line of centres and 90 degrees on.  Exact for a short bearing; 4 % low at L/D 1, measured.
Eigen::Vector2d parabolic_force(double length_ratio, double eccentricity);
/// Eccentricity at which such a film carries this force.
double parabolic_eccentricity(double length_ratio, double force);
}  // namespace mill::bearing
