#pragma once
#include "core/model/bearing_ratings.h"
#include "reduce/bearing/roller_law.h"

// Formulas that need no equilibrium: sanity of the geometry and of the assembled stiffness.  theory.md 5.7
namespace mill::bearing {
using mill::rating_factor;
using mill::Ratings;
using mill::ratings;

/// Radial tangent of a roller bearing without clearance by one formula, N/m, SI:
///   k = 1e9 (i Z)^0.9 L^0.8 F^0.1 cos(a)^1.9
/// Source: M. I. Friswell, J. E. T. Penny, S. D. Garvey, A. W. Lees, Dynamics of Rotating Machines (2010), 5.
/// @throws InputError  load not positive
double friswell_stiffness(const RollerBearing &bearing, double radial_load);

/// Range in which the damping of a rolling bearing of this stiffness lies.
struct DampingRange {
  double low;     ///< N s/m
  double middle;  ///< N s/m
  double high;    ///< N s/m
};
/// (0.25, 1.25, 2.5) 1e-5 s times the stiffness (N/m).  Source: as friswell_stiffness.
DampingRange bearing_damping(double stiffness);

/// Load-approach law with a formula for each contact that knows the raceway's radius, as one lamina in the middle
/// of the roller: both contacts in series on the cup's normal by the force triangle of roller, cup, cone and rib,
///   G = 4.80 ((1 - nu1^2)/(pi E1) + (1 - nu2^2)/(pi E2))^0.9 (1 +- D_w/D_race)^0.1 / (L^0.74 D_w^0.1)
///   K_n = (G_o + G_i (Q_i/Q_o)^0.9 cos(alpha_o - alpha_i))^(-10/9)
/// @param inner_raceway, outer_raceway  m, diameters at mid-roller
/// Source: Luo's formula in Zhang, Lv, Han, Li, Sensors 23 (2023) 4967, eq. 3-16.
RollerLaw luo_law(const RollerBearing &bearing, double inner_raceway, double outer_raceway);
}  // namespace mill::bearing
