#pragma once
#include "fem/contact/friction.h"
#include "fem/contact/half_space.h"
#include <functional>

// Contacts with stick and slip on half planes and half spaces: the problems for FrictionSolver, and what is read
// off its states.  theory.md 33.4
namespace mill::contact {
/// Equal strips on half planes; motions: approach, and the tangential motion of body 1.
struct StripContact {
  FrictionProblem problem;
  Eigen::VectorXd x;  ///< (n) m
  double width;       ///< m, of a strip
};

/// @param reach  m, from the middle to both sides
/// @param gap    m, over x
/// @param datum  m, of strip_influence
StripContact strip_contact(const HalfSpaces &bodies, const std::function<double(double)> &gap, double reach, int n,
                           double datum, double mu);

/// Equal rectangles on half spaces, as few of them as the symmetry leaves.
struct RectangleGrid {
  double half_x = 0, half_z = 0;  ///< m, reach from the middle
  int n_x = 0, n_z = 0;           ///< over the kept part
  bool mirror_x = false;          ///< x >= 0 is kept
  bool mirror_z = false;          ///< z >= 0 is kept
  bool along    = false;          ///< the tangential motion is along z, else along x
};

/// Motions: approach, and the tangential motion of body 1 in the direction of the grid.
struct RectangleContact {
  FrictionProblem problem;
  Eigen::MatrixXd place;  ///< (n, 2) m, x and z
  double area;            ///< m2, of a rectangle
  double width;           ///< m, of a rectangle along x
  double share;           ///< -, of the load that the kept part carries
  bool along;
};

/// Unlike materials couple pressure and tangential motion and leave no mirror across the tangential load.
/// @param gap  m, over x and z; infinite outside the body
/// @throws InputError  no rectangle with a finite gap
RectangleContact rectangle_contact(const HalfSpaces &bodies, const std::function<double(double, double)> &gap,
                                   const RectangleGrid &grid, double mu);

/// Tangential force of each rectangle along the tangential motion, (n) N.
Eigen::VectorXd along_motion(const RectangleContact &contact, const FrictionState &state);

/// Edge of what sticks, read finer than the grid: where  mu p - t  vanishes, whose square is linear in the squared
/// distance (the traction of Cattaneo and Mindlin).
struct StickEdge {
  double stick;     ///< m, half width or radius of what sticks; 0: nothing, NaN: too few elements
  double traction;  ///< Pa, there, by the elements that slip; NaN: too few of them
};

/// @param distance  (n) m, from the middle; elements with a negative one are not used
/// @param along     (n) N, tangential force
/// @param area      m2 or m, of an element
StickEdge stick_edge(const FrictionState &state, const Eigen::VectorXd &distance, const Eigen::VectorXd &along,
                     double mu, double area);
}  // namespace mill::contact
