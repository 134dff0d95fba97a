#pragma once
#include "core/model/material.h"
#include <Eigen/Core>

// Surface displacement of elastic half spaces under uniform tractions.  theory.md 10
namespace mill::contact {
/// Two half spaces that press on each other over small patches of their plane boundary.
/// Body 1 fills z > 0, body 2 fills z < 0.  A traction (tx, ty, tz) acts on body 1 and its opposite on body 2, so
/// that tz > 0 is a pressure; "displacement" is that of body 1 minus that of body 2. A rigid body has an infinite
/// Young's modulus.
struct HalfSpaces {
  double normal = 0;  ///< 1/Pa, sum of (1 - nu^2) / (pi E):          w = normal p int 1/r
  double shear  = 0;  ///< 1/Pa, sum of (1 - nu) / (2 pi G):          u = t int shear / r + along x^2 / r^3
  double along  = 0;  ///< 1/Pa, sum of nu / (2 pi G):                see shear; also v = along t int x y / r^3
  double coupling =
      0;  ///< 1/Pa, difference of (1 - 2 nu) / (4 pi G): w = coupling t int x / r^2; 0 for equal bodies
};

/// @throws InputError  a modulus not positive, a Poisson ratio outside 0 .. 0.5, or two rigid bodies
HalfSpaces half_spaces(const Material &body1, const Material &body2);

/// Infinite Young's modulus: a punch that does not deform.
Material rigid_material();

/// E* = 1 / (pi normal), Pa.
double contact_modulus(const HalfSpaces &bodies);

/// Rectangle with sides 2 half_x by 2 half_y, centre at the origin.
struct Rectangle {
  double half_x;  ///< m
  double half_y;  ///< m
};

/// Integrals over a rectangle of the kernels that all surface displacements are made of.  With (X, Y) from the
/// point of the load to the point (x, y) and r its length.
struct KernelIntegrals {
  double one;  ///< m, int 1 / r
  double xx;   ///< m, int X^2 / r^3; the one with Y^2 is one - xx
  double xy;   ///< m, int X Y / r^3
  double x;    ///< m, int X / r^2
  double y;    ///< m, int Y / r^2
};

/// Closed form near the rectangle, Gauss points where the closed form would be a difference of nearly equal
/// numbers; relative accuracy of `one` about 1e-13 at any distance and for sides of any ratio.  (x, y) may lie
/// inside, on the edge or at a corner.
/// @throws InputError  a half side not positive
/// Source: A. E. H. Love, Phil. Trans. A 228 (1929) 377 (one, x, y); K. L. Johnson, Contact Mechanics (1985), 3.2
/// and 3.6.
KernelIntegrals kernel_integrals(const Rectangle &rectangle, double x, double y);

/// Displacement (rows x, y, z) at (x, y), m, by a uniform unit traction (columns x, y, z), 1 Pa, on the rectangle:
/// Love's and Cerruti's problem with the coupling of unlike bodies.  Zero at infinity.
Eigen::Matrix3d rectangle_influence(const HalfSpaces &bodies, const Rectangle &rectangle, double x, double y);

/// The same of a concentrated unit force, 1 N, at the origin, m; (x, y) not at the origin.
Eigen::Matrix3d point_influence(const HalfSpaces &bodies, double x, double y);

/// Mean over a rectangle `to` of the integral of 1 / r over a rectangle `from`, m, centres (x, y) apart: what a
/// variational boundary element needs.  mean_potential(a, b) / area(b) is symmetric in a and b. Relative accuracy
/// 1e-9 (sides up to 1 : 1000). Source: the fourfold primitive of 1 / r in the plane is that of C. Hoer, C. Love,
/// J. Res. NBS 69C (1965) 127.
double mean_potential(const Rectangle &from, const Rectangle &to, double x, double y);

/// Plane strain: displacement (rows x, z) at x, m, by a uniform unit traction (columns x, z), 1 Pa, on a strip of
/// width 2 half_width about 0.  A line load moves the far field without limit, so zero is where the distance is
/// `datum`: the kernel is ln(datum / distance), not a displacement of any body.
/// @throws InputError  half width or datum not positive
Eigen::Matrix2d strip_influence(const HalfSpaces &bodies, double half_width, double x, double datum);
}  // namespace mill::contact
