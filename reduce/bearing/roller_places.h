#pragma once
#include "core/model/roller_bearing.h"
#include <Eigen/Core>

namespace mill::bearing {
/// Where the rollers stand and how a motion of the inner ring presses them.  theory.md 5.5
struct RollerPlaces {
  int rows = 0, rollers = 0, modes = 0;
  Eigen::VectorXd azimuth;  ///< (Z) rad, from x
  Eigen::VectorXd hand;     ///< (rows) +1 or -1: axial direction in which the row's inner ring presses its rollers
  Eigen::VectorXd z;        ///< (rows) m, middle of each row
  /// (rows Z modes, 5): coefficients of the approach along the contact line by Legendre polynomials P_a(2x/L) for
  /// a unit of each motion; row (row * Z + roller) * modes + a.  Only a = 0 and 1 are not zero.
  Eigen::MatrixXd press;
};

/// @param modes  at least 2
/// @throws InputError  several rows without width; hands other than + and -; bearing without pitch diameter
RollerPlaces roller_places(const RollerBearing &bearing, double cage_angle, int modes);

/// (rows) +1, -1 from arrangement, repeated over the rows.
/// @throws InputError  empty, or another character
Eigen::VectorXd row_signs(const RollerBearing &bearing);
}  // namespace mill::bearing
