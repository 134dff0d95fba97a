#pragma once
#include <Eigen/Core>

namespace mill::reduce {
/// Two-node Timoshenko element of one plane, exact under end loads.  Unknowns: deflection and rotation of either
/// end. theory.md (51.8).  Source: J. S. Przemieniecki, Theory of Matrix Structural Analysis (1968), section 5.6.
struct BeamElement {
  double length      = 0;  ///< m
  double bending     = 0;  ///< N m2, E I
  double shear_ratio = 0;  ///< -, 12 E I / (kappa G A length^2)
  double mass        = 0;  ///< kg/m
  double rotary      = 0;  ///< kg m, of the section about its diameter

  Eigen::Vector4d shape(double t) const;     ///< deflection at t (0 .. 1) of unit unknowns
  Eigen::Vector4d rotation(double t) const;  ///< rotation of the section at t
  Eigen::Matrix4d stiffness() const;
  Eigen::Matrix4d mass_matrix() const;  ///< consistent, with the rotation of the sections
};

/// Gauss points of 0 .. 1, exact for polynomials up to the power 9.
struct UnitGauss {
  static constexpr int n = 5;
  static const double place[n], weight[n];
};
}  // namespace mill::reduce
