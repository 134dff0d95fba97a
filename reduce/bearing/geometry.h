#pragma once
#include "core/model/roller_bearing.h"
#include <Eigen/Core>

namespace mill::bearing {
/// Angles with which roller, cup and cone of a tapered row share one apex, so that the rollers roll without slip.
struct ApexClosure {
  double axis_angle;               ///< rad, of the roller axis, (5.1)
  double cup_angle;                ///< rad, contact angle of the outer raceway
  double cone_angle;               ///< rad, contact angle of the inner raceway
  double largest_roller_diameter;  ///< m, at which neighbouring rollers touch on the pitch circle
};

/// Closes the apex condition  sin(axis) = (D_pw / D_we) tan(beta).  theory.md 5.1
/// @param pitch_diameter, roller_diameter  m, at mid-roller
/// @param roller_cone_angle  rad, included angle 2 beta of the roller
/// @throws InputError  no angle closes: the included angle is too large for this pair of diameters
ApexClosure apex_closure(double pitch_diameter, double roller_diameter, double roller_cone_angle,
                         int rollers_per_row);

/// Refuses a tapered bearing whose cup angle is more than 0.5 deg away from the closing one; a catalogue angle is
/// not known better.  Does nothing for a cylindrical bearing or without a roller diameter.
/// @throws InputError  with the closing angle and the roller diameter that would close the given angle
void require_closed_apex(const RollerBearing &bearing);

using mill::pitch_diameter;

/// Axial positions of the row centres (rows), m, symmetric about the middle of the bearing, pitch = width / rows.
/// NaN when the width is not given and there is more than one row.
Eigen::VectorXd row_positions(const RollerBearing &bearing);

/// Azimuth of the rollers of a row (rollers_per_row), rad; roller 0 lies on the line of the load.
Eigen::VectorXd roller_azimuths(const RollerBearing &bearing);
}  // namespace mill::bearing
