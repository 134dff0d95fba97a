#pragma once
#include "core/model/roller_bearing.h"
#include <Eigen/Core>
#include <vector>

namespace mill::bearing {
/// One radially loaded bearing between rigid rings, at one load.  theory.md 5.4
struct BearingState {
  double load            = 0;      ///< N, radial, on the line of roller 0
  double tilt            = 0;      ///< rad, of the inner ring in the plane of the load
  double displacement    = 0;      ///< m, of the inner ring's middle from the concentric position
  double secant          = 0;      ///< N/m, load / displacement: clearance take-up included
  double tangent         = 0;      ///< N/m, d(load)/d(displacement) at fixed tilt, exact
  double roller_max      = 0;      ///< N, load of the heaviest roller, normal to the raceway
  double roller_approach = 0;      ///< m, of that roller, both raceways together
  double roller_secant   = 0;      ///< N/m, of that roller
  double roller_tangent  = 0;      ///< N/m, of that roller
  Eigen::VectorXi loaded_rollers;  ///< (rows), rollers that carry load
  Eigen::VectorXd row_share;       ///< (rows) -, radial force of the row / load; negative: loaded on the far side
  Eigen::VectorXd azimuth;         ///< (rollers) rad, from the line of the load
  Eigen::MatrixXd roller_load;     ///< (rows, rollers) N, normal to the raceway
};

/// Equilibrium of the inner ring under a radial load: rows x rollers x laminae by the bearing's roller law,
/// profile, clearance and contact angle; rigid rings, no axial displacement, tilt prescribed.
///
/// @param bearing      tapered or cylindrical; `radial_clearance` is diametral, measured radially on the drawing
/// @param radial_load  N, > 0, of the whole bearing
/// @param tilt         rad, of the inner ring; needs `width` and a pitch diameter, from which the places of the
///                     rollers follow, and takes `arrangement`: the rim's axial motion is used
///
/// @throws InputError   load not positive (no roller would carry, or the stiffness would be zero);
///                      apex condition not closed by more than 0.5 deg; tilt without width or pitch diameter;
///                      profile or law unknown
/// @throws SolverError  no displacement found in 200 steps: NaN among the inputs
/// Bracketed Newton: the force never falls as the ring moves, so the root is unique and always found.
/// Cost rows x rollers x laminae powers per step (one row without tilt), some 8 steps; under 5 ms for 4 x 39 x 41.
/// Source: ISO/TS 16281:2008, section 4, eq. (35)-(46), with the contact angle as in theory.md (5.11)-(5.14).
BearingState solve_bearing(const RollerBearing &bearing, double radial_load, double tilt = 0);
}  // namespace mill::bearing
