#pragma once
#include "core/model/material.h"
#include <array>

// Two long bodies in plane strain: Hertz pressure, and an approach whose datum is stated.  theory.md 33.1
namespace mill::contact {
/// A cylinder or a plane.
struct LineBody {
  double radius;      ///< m; infinite: a plane
  Material material;  ///< rigid_material() does not deform
  double depth;       ///< m, of an elastic plane: where the point lies from which the approach is counted
};

/// Distance, m, at which the surface of a half plane has to stand still so that its contact approaches by as much
/// as the body: the axis of a cylinder balanced by an equal load on the opposite side, or a point of a plane.
/// theory.md (33.2), (33.3)
double half_plane_datum(const LineBody &body);

struct LineApproach {
  double half_width;     ///< m
  double peak_pressure;  ///< Pa
  double approach;       ///< m, the two datum points towards each other
  double secant;         ///< N/m2, line load / approach
  double tangent;        ///< N/m2
};

/// @param line_load  N/m, > 0
/// @throws InputError  not positive: load, radius, depth of an elastic plane; two planes; two rigid bodies
/// Cost O(1).  Source: K. L. Johnson, Contact Mechanics (1985), 4.2, eq. 5.56 and 5.57.
LineApproach line_bodies(const std::array<LineBody, 2> &bodies, double line_load);

/// Distance, m, for strip_influence: the mean of both datum distances with the compliances as weights.
double common_datum(const std::array<LineBody, 2> &bodies);

/// m: 1 / radius = sum of both curvatures.
double relative_radius(double radius1, double radius2);
}  // namespace mill::contact
