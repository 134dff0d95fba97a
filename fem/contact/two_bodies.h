#pragma once
#include "core/model/two_cylinders.h"
#include "fem/contact/half_space_contact.h"
#include "fem/contact/line_bodies.h"
#include <array>

// The two bodies of kind two-cylinders as the engines and the closed forms want them.
namespace mill::contact {
std::array<LineBody, 2> line_bodies_of(const TwoCylinders &pair);
HalfSpaces half_spaces_of(const TwoCylinders &pair);

/// Contact in space: gap of the undeformed bodies without tilt.
struct SpaceShape {
  HalfSpaces bodies;
  double modulus   = 0;                ///< Pa, E*
  double radius    = 0;                ///< m, relative, across the axes
  double curvature = 0;                ///< 1/m, relative, along the axes; 0: straight generators
  double length    = 0;                ///< m, of the shorter face; infinite without one
  bool relieved    = false;            ///< a profile at the ends
  bool symmetric   = true;             ///< about mid-length, without tilt
  std::function<double(double)> drop;  ///< m, over z: crowns and profiles; infinite beyond the face

  /// m, from the first touch of the tilted bodies.
  GapShape gap(double tilt) const;
  /// How far the bodies have come together at mid-length, m, against the same without tilt, when they first touch.
  double first_touch(double tilt) const;
  /// A contact ellipse that the faces do not cut, at this load; else the contact is as long as the faces.
  bool is_point(double load, double tilt) const;
  /// What a load (N) does where the bodies carry it in slices that do not feel each other.  theory.md (33.7)
  struct Slices {
    double length;  ///< m, that carries
    double moment;  ///< N m, about mid-length
  };
  Slices slices(double load, double tilt) const;
};
SpaceShape space_shape(const TwoCylinders &pair);
}  // namespace mill::contact
