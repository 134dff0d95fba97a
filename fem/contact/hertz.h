#pragma once
#include "fem/contact/half_space.h"

// Closed forms of contact mechanics.  theory.md 10
namespace mill::contact {
/// Hertz contact of two bodies with principal relative radii of curvature, axes aligned.
struct PointContact {
  double load;           ///< N
  double semi_x;         ///< m, half axis of the contact ellipse in the direction of radius_x
  double semi_y;         ///< m, in the direction of radius_y
  double peak_pressure;  ///< Pa
  double approach;       ///< m, of points far from the contact
  double secant;         ///< N/m, load / approach
  double tangent;        ///< N/m, d(load) / d(approach) = 1.5 secant
};

/// @param load     N, > 0
/// @param radius_x, radius_y  m, > 0: 1 / radius = 1 / radius of body 1 + 1 / radius of body 2 in that direction
/// @param modulus  Pa, E* of half_space.h, contact_modulus
/// @throws InputError  a value not positive
/// Equal radii give the sphere; no accuracy is lost for slender ellipses (axis ratios beyond 1e4), since the
/// complete elliptic integrals are taken by the arithmetic-geometric mean in the combinations that do not cancel.
/// Cost: some microseconds. Source: K. L. Johnson, Contact Mechanics (1985), 4.2; elliptic integrals: Abramowitz
/// and Stegun, 17.6.
PointContact hertz_point(double load, double radius_x, double radius_y, double modulus);

/// The same contact by its approach (m, > 0) instead of its load.
PointContact hertz_point_at(double approach, double radius_x, double radius_y, double modulus);

struct HertzLine {
  double half_width;     ///< m
  double peak_pressure;  ///< Pa
};

/// Plane-strain contact under `line_load` (N/m, > 0) with relative radius `radius` (m).  It has no approach of its
/// own: see cylinder_approach.
/// @throws InputError  a value not positive
HertzLine hertz_line(double line_load, double radius, double modulus);

/// Approach, m, of the axis of a cylinder (radius, m) and the contact under `line_load` (N/m) spread over
/// `half_width` (m), the cylinder balanced by an equal load on the opposite side.  The approach of two axes is the
/// sum for both. Source: Johnson (1985), eq. 5.57.
double cylinder_approach(double line_load, double radius, double half_width, const Material &material);

/// Tangential load below mu times the normal load: the middle of the contact sticks, the rim slips.
struct PartialSlip {
  double stick;       ///< m, half width or radius of the region that sticks
  double tangential;  ///< m, tangential approach; NaN for a line contact, which has no value of its own
  double stiffness;   ///< N/m, of the first increment, when all of the contact sticks; NaN for a line contact
};

/// Cattaneo and Mindlin: cylinders, equal materials.  `load_ratio` = Q / (mu P), in 0 .. 1 (1: gross slip, nothing
/// sticks).
/// @throws InputError  load_ratio outside 0 .. 1
PartialSlip cattaneo_line(const HertzLine &contact, double load_ratio);

/// Tangential traction, Pa, at x (m) of the same, friction coefficient mu.
double cattaneo_traction(const HertzLine &contact, const PartialSlip &slip, double mu, double x);

/// Cattaneo and Mindlin: spheres, equal materials or at least no coupling; mu is the friction coefficient.
/// @throws InputError  load_ratio outside 0 .. 1, or semi-axes that differ
/// Source: R. D. Mindlin, J. Appl. Mech. 16 (1949) 259; Johnson (1985), 7.2.
PartialSlip mindlin_sphere(const PointContact &contact, const HalfSpaces &bodies, double mu, double load_ratio);

/// Cattaneo and Mindlin on an ellipse whose axes the load follows: what sticks is an ellipse of the same shape,
/// theory.md (33.8), (33.9).  Exact without coupling and where slip stays along the load (nu = 0), else an
/// approximation within a few percent.
struct EllipticSlip {
  double stick_x, stick_y;  ///< m, semi-axes of what sticks
  double tangential;        ///< m, tangential approach
  double stiffness;         ///< N/m, of the first increment
};

/// @param along_y  the load is along y, else along x
/// @throws InputError  load_ratio outside 0 .. 1
/// Source: P. J. Vermeulen, K. L. Johnson, J. Appl. Mech. 31 (1964) 338; R. D. Mindlin (1949).
EllipticSlip mindlin_ellipse(const PointContact &contact, const HalfSpaces &bodies, double mu, double load_ratio,
                             bool along_y);

/// Approach of a half space at the middle of a line of length `length` (m) under a uniform line load (N/m) with
/// Hertz pressure of half width `half_width` (m) across; Lundberg's.  theory.md (33.6)
struct FiniteLine {
  double approach;  ///< m
  double secant;    ///< N/m, load / approach
  double tangent;   ///< N/m
};
/// @throws InputError  a value not positive, or a line not longer than wide
FiniteLine lundberg_line(const HertzLine &contact, double line_load, double length, double modulus);

/// Rigid, flat, frictionless punch with a circular face, not tilted.
struct CircularPunch {
  double approach;       ///< m
  double stiffness;      ///< N/m, 2 a E*, at every load
  double mean_pressure;  ///< Pa; half of it in the middle
};

/// @throws InputError  a value not positive
CircularPunch circular_punch(double load, double radius, double modulus);

/// Pressure, Pa, at the distance r (m) from the middle of a circular punch; infinite at the edge, 0 outside.
double circular_punch_pressure(double load, double radius, double r);

/// Pressure, Pa, at x (m) under a flat strip punch of half width `half_width` (m); infinite at the edge, 0
/// outside.
double strip_punch_pressure(double line_load, double half_width, double x);
}  // namespace mill::contact
