#include "reduce/bearing/roller_places.h"
#include "core/base/errors.h"
#include "core/base/text.h"
#include "reduce/bearing/geometry.h"
#include <cmath>

namespace mill::bearing {
Eigen::VectorXd row_signs(const RollerBearing &b)
{
  if (!has_only(b.arrangement, "+-") || b.arrangement.empty())
    throw InputError("bearing." + b.name + ": arrangement = \"" + b.arrangement +
                     "\" must be + and - only, for example \"+-+-\"");
  Eigen::VectorXd hands(b.rows);
  for (int r = 0; r < b.rows; ++r)
    hands[r] = b.arrangement[std::size_t(r) % b.arrangement.size()] == '+' ? 1 : -1;
  return hands;
}

RollerPlaces roller_places(const RollerBearing &b, const double cage_angle, const int modes)
{
  RollerPlaces places;
  places.rows    = b.rows;
  places.rollers = b.rollers_per_row;
  places.modes   = modes;
  places.azimuth = roller_azimuths(b).array() + cage_angle;
  places.hand    = row_signs(b);
  places.z       = row_positions(b);
  if (!places.z.allFinite())
    throw InputError("bearing." + b.name +
                     ": several rows need the bearing width, from which their positions follow");
  const double R = pitch_diameter(b) / 2, ca = std::cos(b.cup_angle), sa = std::sin(b.cup_angle);
  if (!(R > 0))
    throw InputError("bearing." + b.name + ": needs pitch_diameter, or bore and outside_diameter");
  places.press = Eigen::MatrixXd::Zero(Eigen::Index(b.rows) * b.rollers_per_row * modes, 5);
  for (int r = 0; r < b.rows; ++r)
    for (int j = 0; j < b.rollers_per_row; ++j) {
      const double c = std::cos(places.azimuth[j]), s = std::sin(places.azimuth[j]);
      const double lever       = places.z[r] * ca - R * places.hand[r] * sa;  // (p x n), about x: -s, about y: +c
      const Eigen::Index first = Eigen::Index(r * b.rollers_per_row + j) * modes;
      places.press.row(first) << ca * c, ca * s, places.hand[r] * sa, -lever * s, lever * c;
      // Along the line the arm grows by one metre for each metre, for any angle: (t x n) = (-s, c).
      places.press.row(first + 1) << 0, 0, 0, -b.roller_length / 2 * s, b.roller_length / 2 * c;
    }
  return places;
}
}  // namespace mill::bearing
