#pragma once
#include "reduce/bite/bite.h"

// Where the pressure of an elastic arc is taken.
namespace mill::bite {
/// What a solution knows of its contact, for the next grid.
struct ArcEnds {
  double first, last;  ///< m, ends of the contact
  double exit, entry;  ///< m, ends of the plastic arc
  double neutral;      ///< m
};

/// Points over the contact and some margin: close at the entry, where the pressure climbs over a short elastic
/// zone, and at the exit, closer at the neutral point, growing by a sixth from one to the next in between.
/// @param n  about as many points
Eigen::VectorXd graded_arc(const ArcEnds &ends, int n);

/// Displacement of the surface at the points of the pressure and its slope along x, by unit pressures.
struct ArcMatrices {
  Eigen::MatrixXd value;  ///< (n, n) m/Pa
  Eigen::MatrixXd slope;  ///< (n, n) 1/Pa
};

/// Flexibility at these points: half plane, plus the interpolated difference of a given flexibility from it.
/// @throws SolverError  the given flexibility does not reach over the points
ArcMatrices flexibility_at(const Eigen::VectorXd &position, const Material &roll, double roll_radius,
                           const ArcFlexibility *given);

/// Weights of the trapezoidal rule.
Eigen::VectorXd arc_weights(const Eigen::VectorXd &position);
}  // namespace mill::bite
