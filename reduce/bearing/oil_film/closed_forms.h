#pragma once
#include <Eigen/Core>

// Films with a closed solution, in addition to the grid of film.h; units of FilmReactions.  theory.md 29.6
namespace mill::bearing {
/// Short bearing (Ocvirk), film ruptured over the diverging half: force, rad between load and line of centres.
double ocvirk_force(double length_ratio, double eccentricity);
double ocvirk_attitude(double eccentricity);
/// Eccentricity at which a short bearing carries this force.
double ocvirk_eccentricity(double length_ratio, double force);
/// Stiffness and damping of the short bearing, along the load and across it, over its force.
struct ClosedCoefficients {
  Eigen::Matrix2d stiffness;  ///< K = k c/W
  Eigen::Matrix2d damping;    ///< B = b c w/W
};
ClosedCoefficients ocvirk_coefficients(double eccentricity);

/// Infinitely long bearing: force of the whole length per half length, with a film that does not rupture
/// (Sommerfeld), at 90 degrees from the line of centres.
double sommerfeld_force(double eccentricity);
/// Friction torque of a full film without load, in mu w R^3 L/2 / c (Petroff).
double petroff_friction();
}  // namespace mill::bearing
