#pragma once
#include "fem/roll/contact_study.h"

// What is read off a solved contact beyond its curve and its distribution along the barrel.
namespace mill::fem {
/// Pressure over the patch at one load, (n_z, 2 n_x - 1) Pa, both sides of the contact line.
Eigen::MatrixXd pressure_map(const ContactPair &pair, const ContactPoint &point);

/// Tangent stiffness of the joint between the two axes, (6, 6) N/m, N, N m: relative motion of the second roll
/// against the first at mid-length along x, y, z and about x, y, z (y closes the contact, z is the axis).
/// Frictionless: what remains along x and about y is the geometric term of the force, a rotation about z meets
/// nothing.  theory.md (2.14)
/// Needs a pair of the whole whose axes stay straight (held_by_mirror).
Eigen::Matrix<double, 6, 6> joint_stiffness(const ContactPair &pair, const ContactPoint &point);

/// The same as a smooth function of the load: every entry is fitted by a straight line in ln F through a third
/// below and above, so that it does not step as nodes come into contact.  theory.md 2.7
/// @param largest  N, no load above it is solved
Eigen::Matrix<double, 6, 6> fitted_joint_stiffness(const ContactPair &pair, double load, double largest);

/// Mean over the trimmed path of nodal force over nodal relative displacement, as published stiffnesses were
/// evaluated: force of a station (sum over the width) over its approach.  theory.md (2.15)
struct PathPlateau {
  double mean;              ///< N/m
  double tributary_length;  ///< m, mean length that belongs to a station
  int stations;             ///< how many remain after trimming
};
/// @param trim  share of the contact length left out at each end
PathPlateau path_plateau(const ContactPair &pair, const ContactPoint &point, double trim);
}  // namespace mill::fem
