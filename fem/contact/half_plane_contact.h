#pragma once
#include "fem/contact/half_space.h"
#include <Eigen/Core>

// Normal contact of two long bodies as half planes by boundary elements.  theory.md 33.2
namespace mill::contact {
struct HalfPlanePair {
  HalfSpaces bodies;
  double radius = 0;  ///< m, relative
  double datum  = 0;  ///< m, line_bodies.h, common_datum
};

struct HalfPlaneState {
  double approach      = 0;  ///< m
  double half_width    = 0;  ///< m, by fit_pressure
  double peak_pressure = 0;  ///< Pa
  Eigen::VectorXd x;         ///< (n) m, middle of each strip
  Eigen::VectorXd pressure;  ///< (n) Pa
  int iterations  = 0;
  double residual = 0;  ///< -
};

/// @param line_load  N/m, > 0
/// @param n          strips over 2.5 Hertz half widths
/// Cost: n^2 kernels and an active set of n unknowns.
HalfPlaneState half_plane_contact(const HalfPlanePair &pair, double line_load, int n);

/// d(line load) / d(approach), N/m2, by smooth_tangent.
double half_plane_tangent(const HalfPlanePair &pair, double line_load, int n);
}  // namespace mill::contact
