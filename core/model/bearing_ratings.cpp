#include "core/model/bearing_ratings.h"
#include "core/base/errors.h"
#include "core/numerics/root_search.h"
#include <algorithm>
#include <cmath>

namespace mill {
double pitch_diameter(const RollerBearing &b)
{
  return std::isfinite(b.pitch_diameter) ? b.pitch_diameter : (b.bore + b.outside_diameter) / 2;
}

double rating_factor(const double g)
{
  if (!(g > 0 && g < 1))
    throw InputError("bearing: roller diameter times cos(cup angle) over pitch diameter must lie between 0 and 1");
  const double ratio = (1 - g) / (1 + g);
  const double outer = std::pow(1.04 * std::pow(ratio, 143.0 / 108), 9.0 / 2);  // cup against cone
  return 207.9 * 0.83 * std::pow(g, 2.0 / 9) * std::pow(1 - g, 29.0 / 27) / std::pow(1 + g, 0.25) *
         std::pow(1 + outer, -2.0 / 9);
}

Ratings ratings(const RollerBearing &b)
{
  if (!(b.roller_diameter > 0 && pitch_diameter(b) > 0))
    throw InputError("bearing." + b.name + ": ratings need roller_diameter and a pitch diameter");
  const double ca = std::cos(b.cup_angle), cot = 1 / std::tan(b.cup_angle);
  const double D = 1e3 * b.roller_diameter, L = 1e3 * b.roller_length;  // the formulas hold in N and mm
  const double g = b.roller_diameter * ca / pitch_diameter(b), i = b.rows, Z = b.rollers_per_row;
  const double b_m = 1.1;  // roller bearings of contemporary steel
  return {b_m * rating_factor(g) * std::pow(i * L * ca, 7.0 / 9) * std::pow(Z, 0.75) * std::pow(D, 29.0 / 27),
          44 * (1 - g) * i * Z * L * D * ca,
          1.5 * std::tan(b.cup_angle),
          0.4,
          0.4 * cot,
          0.45 * cot,
          0.67,
          0.67 * cot};
}

bool is_rating_of_90_million(const double rating, const double by_formula, const double scatter)
{
  const double expected = by_formula / ratings_90_to_1;
  return rating > expected / scatter && rating < expected * scatter;
}

namespace {
// Length that gives the static rating with this diameter and number.  (5.40)
double length_of(const RollerBearing &b, const double diameter, const int Z)
{
  const double ca = std::cos(b.cup_angle), g = diameter * ca / pitch_diameter(b);
  return b.static_rating / (44e6 * (1 - g) * b.rows * Z * diameter * ca);
}

double dynamic_of(RollerBearing b, const double diameter, const int Z)
{
  b.roller_diameter = diameter;
  b.rollers_per_row = Z;
  b.roller_length   = length_of(b, diameter, Z);
  return ratings(b).dynamic;
}

// Diameter at which the pair of ratings closes; NaN where no roller that is left room does.  With
// (5.40) put in, (5.29) grows with the diameter as D^(14/27) and more slowly with 1 - g and f_c: one root.
double diameter_of(const RollerBearing &b, const int Z)
{
  const double D_pw = pitch_diameter(b);
  return root_between(1e-4 * D_pw, std::min(M_PI / Z, 0.4) * D_pw,
                      [&](const double diameter) { return dynamic_of(b, diameter, Z) - b.dynamic_rating; })
      .value_or(not_given);
}

bool has_room(const RollerBearing &b, const RollerCandidate &c)
{
  const double walls = (b.outside_diameter - b.bore) / 2, row = b.width / b.rows;  // NaN: no limit
  return !(c.roller_diameter > 0.9 * walls) && !(c.roller_length * std::cos(c.cup_angle) > row);
}

// How far a candidate is from what is known, or from the middle of the fillings.
double distance(const RollerCandidate &c, const KnownRollers &known)
{
  if (std::isfinite(known.roller_diameter))
    return std::abs(c.roller_diameter / known.roller_diameter - 1);
  if (std::isfinite(known.roller_length))
    return std::abs(c.roller_length / known.roller_length - 1);
  return std::abs(c.filling - (least_filling + largest_filling) / 2);
}

// (5.30) without what all candidates share.
double relative_stiffness(const RollerCandidate &c)
{
  return std::pow(c.rollers_per_row, 0.9) * std::pow(c.roller_length, 0.8) * std::pow(std::cos(c.cup_angle), 1.9);
}
}  // namespace

std::vector<RollerCandidate> roller_candidates(const RollerBearing &b, const KnownRollers &known)
{
  if (!(b.dynamic_rating > 0 && b.static_rating > 0 && pitch_diameter(b) > 0 && b.rows > 0))
    throw InputError("bearing." + b.name +
                     ": rollers that give the ratings need C, C0, rows and a pitch diameter");
  std::vector<RollerCandidate> out;
  const bool fixed = known.rollers_per_row > 0;
  for (int Z = fixed ? known.rollers_per_row : 5; Z <= (fixed ? known.rollers_per_row : 300); ++Z) {
    RollerCandidate c{Z, diameter_of(b, Z), 0, b.cup_angle, 0, 0};
    if (std::isnan(c.roller_diameter))
      continue;
    c.roller_length = length_of(b, c.roller_diameter, Z);
    c.filling       = Z * c.roller_diameter / (M_PI * pitch_diameter(b));
    if (!fixed && c.filling > largest_filling)
      break;  // more rollers of nearly the same diameter fill more
    if (has_room(b, c) && (fixed || (c.filling >= least_filling && c.filling <= largest_filling)))
      out.push_back(c);
  }
  std::stable_sort(out.begin(), out.end(), [&](const RollerCandidate &x, const RollerCandidate &y) {
    return distance(x, known) < distance(y, known);
  });
  relate_stiffness(out);
  return out;
}

void relate_stiffness(std::vector<RollerCandidate> &candidates)
{
  for (std::size_t i = candidates.size(); i-- > 0;)
    candidates[i].stiffness = relative_stiffness(candidates[i]) / relative_stiffness(candidates.front());
}

double stiffness_spread(const std::vector<RollerCandidate> &candidates)
{
  double spread = 0;
  for (const RollerCandidate &c : candidates)
    spread = std::max(spread, std::abs(c.stiffness - 1));
  return spread;
}

double axial_spread(const std::vector<RollerCandidate> &candidates)
{
  const auto axial = [](const RollerCandidate &c) { return c.stiffness * std::pow(std::tan(c.cup_angle), 1.9); };
  double spread    = 0;
  for (const RollerCandidate &c : candidates)
    if (c.cup_angle > 0)
      spread = std::max(spread, std::abs(axial(c) / axial(candidates.front()) - 1));
  return spread;
}

double yield_pressure_of(const double flow_stress, const bool plane_strain, const double nu)
{
  // Stresses on the axis of a line contact at depth z = s b under p_0 = 1; second invariant of their deviator.
  const auto root_J2 = [nu](const double s) {
    const double h = std::hypot(1, s), x = -((1 + 2 * s * s) / h - 2 * s), z = -1 / h, y = nu * (x + z);
    return std::sqrt(((x - y) * (x - y) + (y - z) * (y - z) + (z - x) * (z - x)) / 6);
  };
  const double largest = -minimum_between(0.2, 2, [&](const double s) { return -root_J2(s); }).value;  // near 0.7
  const double k       = plane_strain ? flow_stress / 2 : flow_stress / std::sqrt(3.0);
  return k / largest;
}
}  // namespace mill
