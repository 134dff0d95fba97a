#pragma once
#include "core/model/roller_bearing.h"
#include <cmath>

// Ratings by the formulas of the standards, and the rollers that give a published pair of them. theory.md 5.7, 5.9
namespace mill {
/// f_c of the basic dynamic rating of a radial roller bearing, N and mm.  ISO 281, (5.28)
/// @param g  D_we cos(alpha) / D_pw, between 0 and 1
/// @throws InputError  g outside
double rating_factor(double g);

/// Basic ratings of all rows, and the factors of the equivalent load.
struct Ratings {
  double dynamic;        ///< N, C_r
  double static_rating;  ///< N, C_0r
  double e;              ///< -, axial over radial load above which the axial load enters: 1.5 tan(alpha)
  double X;              ///< -, single row, F_a/F_r > e: 0.4
  double Y;              ///< -, single row, F_a/F_r > e: 0.4 cot(alpha)
  double pair_Y1;        ///< -, pair, F_a/F_r <= e: 0.45 cot(alpha)
  double pair_X2;        ///< -, pair, F_a/F_r > e: 0.67
  double pair_Y2;        ///< -, pair, F_a/F_r > e: 0.67 cot(alpha)
};
/// C_r = b_m f_c (i L cos a)^(7/9) Z^(3/4) D^(29/27) with b_m 1.1, C_0r = 44 (1 - g) i Z L D cos a.  ISO 281,
/// ISO 76, (5.29). The axial factors are infinite for a bearing without contact angle.
/// @throws InputError  roller or pitch diameter missing
Ratings ratings(const RollerBearing &bearing);

/// A rating for 10^6 turns over that for 90 million turns of the same bearing: 90^(3/10), with the exponent 10/3
/// of the life of roller bearings.  ISO 281
inline const double ratings_90_to_1 = std::pow(90.0, 0.3);

/// Is this a rating for 90 million turns?  True where it is within a factor `scatter` of by_formula/90^0.3.
/// @param by_formula  N, rating for 10^6 turns from the rollers
bool is_rating_of_90_million(double rating, double by_formula, double scatter);

/// What of the rollers is known beforehand; zero or NaN: nothing.
struct KnownRollers {
  int rollers_per_row    = 0;
  double roller_diameter = not_given;  ///< m
  double roller_length   = not_given;  ///< m
};

/// How full a pitch circle is of roller diameters, between a caged set with a gap of a fifth of a roller and the
/// tightest one with a cage.
inline constexpr double least_filling = 0.83, largest_filling = 0.97;

/// Every set of rollers that gives dynamic_rating and static_rating of the bearing by (5.28) and (5.29): for each
/// number Z the one pair of diameter and length, as long as the pitch circle is filled between the two limits and
/// the rollers fit between bore, outside diameter and the width of a row.  (5.40), (5.41)
/// The first is nearest to what is known, otherwise to the middle of the fillings.
/// @param b      with both ratings, rows, cup_angle and a pitch diameter
/// @param known  a number of rollers leaves its own candidate only, whatever it fills
/// @throws InputError  ratings, rows or pitch diameter missing
std::vector<RollerCandidate> roller_candidates(const RollerBearing &b, const KnownRollers &known = {});

/// Sets the stiffness of every candidate against that of the first.
void relate_stiffness(std::vector<RollerCandidate> &candidates);

/// Largest relative distance of a candidate's radial stiffness from that of the first; 0 for one or none.
double stiffness_spread(const std::vector<RollerCandidate> &candidates);

/// The same of the stiffness along the axis, as Z^0.9 l^0.8 sin(alpha)^1.9: it hangs on the contact angle.
double axial_spread(const std::vector<RollerCandidate> &candidates);

/// Contact pressure, Pa, at which a raceway under a line contact begins to yield by von Mises' criterion in plane
/// strain.  (5.42)
/// @param flow_stress   Pa
/// @param plane_strain  flow_stress is that of a plane-strain test, 2 k; false: of a tensile test, sqrt(3) k
double yield_pressure_of(double flow_stress, bool plane_strain, double poisson_ratio);
}  // namespace mill
