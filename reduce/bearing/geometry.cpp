#include "reduce/bearing/geometry.h"
#include "core/base/errors.h"
#include <cmath>
#include <sstream>

namespace mill::bearing {
namespace {
constexpr double degree = M_PI / 180;
constexpr double angle_tolerance =
    0.5 * degree;  // what a drawing or a catalogue fixes; 0.5 deg moves Kzc by 0.6 %
}  // namespace

ApexClosure apex_closure(const double D_pw, const double D_we, const double roller_cone_angle,
                         const int rollers_per_row)
{
  const double beta = roller_cone_angle / 2;
  const double sine = D_pw / D_we * std::tan(beta);  // (5.1)
  if (!(sine >= 0 && sine < 1)) {
    std::ostringstream text;
    text << "tapered roller: no cup angle closes the apex condition for a roller cone of "
         << roller_cone_angle / degree << " deg included, roller diameter " << D_we * 1e3
         << " mm and pitch diameter " << D_pw * 1e3 << " mm; is the cone angle the included one?";
    throw InputError(text.str());
  }
  const double axis = std::asin(sine);
  return {axis, axis + beta, axis - beta, M_PI * D_pw / rollers_per_row};
}

void require_closed_apex(const RollerBearing &b)
{
  const double D_pw = pitch_diameter(b);
  if (b.roller_cone_angle == 0 || !std::isfinite(b.roller_diameter) || !std::isfinite(D_pw))
    return;
  const ApexClosure closed = apex_closure(D_pw, b.roller_diameter, b.roller_cone_angle, b.rollers_per_row);
  if (std::abs(b.cup_angle - closed.cup_angle) <= angle_tolerance)
    return;
  const double beta    = b.roller_cone_angle / 2;
  const double closing = D_pw * std::tan(beta) / std::sin(b.cup_angle - beta);  // (5.1) solved for D_we
  std::ostringstream text;
  text.precision(5);
  text << "bearing." << b.name << ": cup angle " << b.cup_angle / degree
       << " deg does not close the apex condition; with a " << b.roller_diameter * 1e3 << " mm roller of "
       << b.roller_cone_angle / degree << " deg included on a " << D_pw * 1e3 << " mm pitch circle it is "
       << closed.cup_angle / degree << " deg";
  if (closing > 0)
    text << "; the given angle would need a roller diameter of " << closing * 1e3 << " mm, "
         << (closing > closed.largest_roller_diameter ? "more than the " : "and there is room for ")
         << closed.largest_roller_diameter * 1e3 << " mm"
         << (closing > closed.largest_roller_diameter ? " at which neighbouring rollers touch" : "");
  throw InputError(text.str());
}

Eigen::VectorXd row_positions(const RollerBearing &b)
{
  if (b.rows == 1)
    return Eigen::VectorXd::Zero(1);
  const double pitch = b.width / b.rows;
  return pitch * Eigen::VectorXd::LinSpaced(b.rows, -(b.rows - 1) / 2.0, (b.rows - 1) / 2.0);
}

Eigen::VectorXd roller_azimuths(const RollerBearing &b)
{
  const int Z = b.rollers_per_row;
  return 2 * M_PI / Z * Eigen::VectorXd::LinSpaced(Z, 0, Z - 1);
}
}  // namespace mill::bearing
