#pragma once
#include "core/model/material.h"
#include <Eigen/Core>

namespace mill::dynamics {
/// Radial force of a bearing over the radial displacement of its inner ring, n samples of increasing load.
struct BearingCurve {
  Eigen::VectorXd displacement;  ///< (n) m, from the concentric position
  Eigen::VectorXd force;         ///< (n) N
  Eigen::VectorXd tangent;       ///< (n) N/m, d(force)/d(displacement)
  double clearance = not_given;  ///< m, displacement at which the first roller is touched; absent: where a power
                                 ///< law of exponent 10/9 through the first sample begins
};

/// The curve, ready for any displacement: zero up to the clearance, a start that meets value and slope of the
/// first sample, between the samples a cubic of  ln F  over  ln(d - clearance)  with the slopes given, limited so
/// that the force never falls.  A power law is met exactly, whatever the samples; force and slope are continuous.
/// theory.md 16
struct BearingLaw {
  double clearance = 0;       ///< m
  Eigen::VectorXd log_depth;  ///< (n) ln(m), of displacement - clearance
  Eigen::VectorXd log_force;  ///< (n) ln(N)
  Eigen::VectorXd exponent;   ///< (n) -, d ln F / d ln(displacement - clearance)
  bool limited = false;       ///< some slope was reduced: the table is coarse or its tangents are not its slopes
  double largest() const;     ///< m, displacement of the last sample; beyond, the curve goes on straight
};

/// @throws InputError  no sample; vectors of different length; numbers that are not positive, not finite or not
///                     increasing; a clearance below zero or not below the first displacement
/// Source of the limit: F. N. Fritsch, R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238.
BearingLaw bearing_law(const BearingCurve &curve);

struct ForceAndSlope {
  double force;    ///< N
  double tangent;  ///< N/m
};

/// At a displacement (m, >= 0).  Cost O(log n), two logarithms' worth.
ForceAndSlope force_at(const BearingLaw &law, double displacement);

/// Displacement under a static load, m; the clearance under none.
/// @param load  N, >= 0
double displacement_under(const BearingLaw &law, double load);
}  // namespace mill::dynamics
