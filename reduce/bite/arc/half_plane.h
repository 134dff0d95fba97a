#pragma once
#include "reduce/bite/bite.h"

// Flexibility of an elastic half plane: what the surface of a large roll is near the bite.
namespace mill::bite {
/// Displacement of the surface of a half plane, plane strain, by pressures that vary linearly between n places.
/// The constant that a half plane leaves open is that of a full roll of the given radius under a line load,
/// towards its axis.  Shear is left out: it acts by (1 - 2 nu)/(2 - 2 nu) of the pressure's share times mu.
/// (17.13)
/// @param position     (n) m, rising, n >= 2
/// @param roll_radius  m
/// @throws InputError  fewer than two places, or places that do not rise
/// Cost O(n^2), 10 ns an entry.  Source: K. L. Johnson, Contact Mechanics (1985), chapter 2.
ArcFlexibility half_plane_flexibility(const Eigen::VectorXd &position, const Material &roll, double roll_radius);

/// Slope of that displacement along x at the same places by the same pressures, 1/Pa (n, n).  The pressure is zero
/// at the first and the last place.
Eigen::MatrixXd half_plane_slope(const Eigen::VectorXd &position, const Material &roll);
}  // namespace mill::bite
