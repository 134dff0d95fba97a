#include "reduce/bearing/roller_profile.h"
#include "core/base/errors.h"
#include "core/model/ground_profile.h"
#include "reduce/bearing/geometry.h"
#include <algorithm>
#include <cmath>
#include <sstream>

namespace mill::bearing {
namespace {
using Eigen::VectorXd;

// Contact pressure on the inner raceway for which a logarithmic profile is ground when no load is stated: heavy
// duty, and below the range where raceways yield.
constexpr double design_pressure = 2e9;

double plane_modulus(const RollerBearing &b)
{
  return b.youngs_modulus / (2 * (1 - b.poisson_ratio * b.poisson_ratio));
}

[[noreturn]] void lacks(const RollerBearing &b, const std::string &needs)
{
  throw InputError("bearing." + b.name + ": profile = \"" + word_of(b.profile) + "\" needs " + needs);
}

/// Line load for which the profile is ground, N/m.
double ground_line_load(const RollerBearing &b)
{
  if (std::isfinite(b.profile_load))
    return b.profile_load / b.roller_length;
  return M_PI * effective_radius(b, true) * design_pressure * design_pressure /
         plane_modulus(b);  // p0 = sqrt(q E'/(pi R))
}

double iso_drop(const RollerBearing &b, const double x)
{
  const double D = b.roller_diameter, L = b.roller_length;
  const auto curve = [](double u) { return -std::log(1 - u * u); };
  if (b.type == BearingType::four_row_tapered)
    return 0.00045 * D * curve(2 * x / L);  // (5.6a)
  if (L <= 2.5 * D)
    return 0.00035 * D * curve(2 * x / L);  // (5.6b)
  const double flat = L - 2.5 * D;          // long rollers: cylindrical in the middle, (5.6c)
  return 0.0005 * D * curve(std::max(0.0, 2 * std::abs(x) - flat) / (2.5 * D));
}

/// Johns and Gohar, (5.7); with rounding 0 it is Lundberg's profile, which has no end.
double log_drop(const RollerBearing &b, const double x, const double rounding)
{
  const double q          = ground_line_load(b),
               half_width = std::sqrt(4 * q * effective_radius(b, true) / (M_PI * plane_modulus(b)));
  return logarithmic_drop(q, half_width, plane_modulus(b), b.roller_length, rounding, x);
}

/// Fujiwara and Kawase: straight in the middle, then a logarithm that ends at the chosen drop.  theory.md 5.6
double three_parameter_drop(const RollerBearing &b, const double x)
{
  const double A       = ground_line_load(b) / (M_PI * plane_modulus(b));
  const double crowned = b.profile_share * b.roller_length / 2;  // at each end
  const double u       = std::max(0.0, std::abs(x) - b.roller_length / 2 + crowned) / crowned;
  return -A * std::log1p(std::expm1(-b.crown_drop / A) * u * u);
}

std::string fmt_mm(const double length)
{
  std::ostringstream text;
  text.precision(6);
  text << 1e3 * length << " mm";
  return text.str();
}

void require_table(const RollerBearing &b, const double reach)
{
  const auto &table = b.profile_table;
  if (table.size() < 2)
    lacks(b, "profile_table with at least two points [x from mid-roller, drop]");
  for (std::size_t i = 1; i < table.size(); ++i)
    if (!(table[i][0] > table[i - 1][0]))
      throw InputError("bearing." + b.name + ": the x of profile_table must increase");
  // Slices are asked for at their middles, so a table that ends at the effective length always reaches.
  // One part in 1e9 for the rounding of the units.
  const double needed = reach * (1 - 1e-9);
  if (table.back()[0] < needed || (table.front()[0] < 0 && table.front()[0] > -needed))
    throw InputError("bearing." + b.name +
                     ": profile_table ends before the roller does; it needs x up to half the roller length, " +
                     fmt_mm(b.roller_length / 2));
}

/// What the profile is made from; throws with the key that is missing.
void require_dimensions(const RollerBearing &b, const VectorXd &x)
{
  using P               = RollerProfile;
  const RollerProfile p = b.profile;
  const bool logarithm  = p == P::log || p == P::lundberg || p == P::three_parameter;
  if ((p == P::crown || p == P::three_parameter) && !std::isfinite(b.crown_drop))
    lacks(b, "crown_drop, the drop at the roller end, for example \"20 um\"");
  if ((p == P::iso || logarithm) && !std::isfinite(b.roller_diameter))
    lacks(b, "roller_diameter");
  if (logarithm && !std::isfinite(pitch_diameter(b)))
    lacks(b, "pitch_diameter, or bore and outside_diameter");
  if (p == P::three_parameter && !(b.profile_share > 0 && b.profile_share <= 1))
    throw InputError("bearing." + b.name + ": profile_share must be above 0 and at most 1");
  if (p == P::three_parameter && !(b.crown_drop > 0))
    throw InputError("bearing." + b.name + ": a three-parameter profile needs a crown_drop above 0");
  if (p == P::table)
    require_table(b, x.size() ? x.cwiseAbs().maxCoeff() : 0);
}

double drop_at(const RollerBearing &b, const double x)
{
  switch (b.profile) {
  case RollerProfile::none:
    return 0;
  case RollerProfile::iso:
    return iso_drop(b, x);
  case RollerProfile::log:
    return log_drop(b, x, johns_gohar);
  case RollerProfile::lundberg:
    return log_drop(b, x, 0);
  case RollerProfile::three_parameter:
    return three_parameter_drop(b, x);
  case RollerProfile::crown:
    return b.crown_drop * std::pow(2 * x / b.roller_length, 2);  // (5.8): circle of large radius
  case RollerProfile::table:
    return table_drop(b.profile_table, x);
  }
  return 0;
}
}  // namespace

double effective_radius(const RollerBearing &b, const bool inner)
{
  const double D_race = pitch_diameter(b) + (inner ? -b.roller_diameter : b.roller_diameter);
  return 1 / (2 / b.roller_diameter + (inner ? 2 : -2) / D_race);
}

VectorXd profile_drop(const RollerBearing &b, const VectorXd &x)
{
  require_dimensions(b, x);
  VectorXd drop = VectorXd::Zero(x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k)
    drop[k] = drop_at(b, x[k]);
  return drop;
}
}  // namespace mill::bearing
