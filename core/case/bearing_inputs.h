#pragma once
#include "core/case/kinds.h"
#include "core/case/pass_inputs.h"
#include "core/model/bearing_case.h"
#include "core/model/four_high.h"
#include "core/model/oil_film_bearing.h"
#include "core/model/roll_kind.h"
#include "core/model/roller_bearing.h"
#include "core/records/key_list.h"
#include <array>
#include <string>
#include <vector>

// What the bearing stages read of a case; as core/case/contact_inputs.h.
namespace mill {
class MovingKeys;

/// A roller bearing in equilibrium.
struct BearingInputs {
  std::string type;                                        ///< which angles are read
  RollerBearing bearing;                                   ///< without what its model does not read
  std::string designation, catalogue;                      ///< that gave what the case does not
  std::array<double, 2> ratings = {not_given, not_given};  ///< N, that rollers were estimated from
};

template <class Io> void each_member(Io &&io, const BearingInputs &record)
{
  const auto &[type, bearing, designation, catalogue, ratings] = record;
  io("type", type);
  io("bearing", bearing);
  io("designation", designation);
  io("catalogue", catalogue);
  io("ratings", ratings);
}

/// What is asked of an equilibrium beyond its motion along the load.
struct BearingReading {
  bool across = false;  ///< rollers away from the load line press their slices unevenly with any profile
  bool askew  = false;  ///< a tilt or an axial force, for which the places of the rows are decisive
};
BearingInputs inputs_of_bearing(const RollerBearing &bearing, const BearingReading &reading = {});

/// In addition, what ratings and life read.
struct RatingInputs {
  double dynamic_rating = 0, static_rating = 0;    ///< N
  double viscosity_ratio = 0, contamination = 0;   ///< -
  double roller_diameter = 0, pitch_diameter = 0;  ///< m
  double bore = 0, outside_diameter = 0;           ///< m
  std::string arrangement;
  double cup_angle      = not_given;            ///< rad, tapered rollers
  double yield_pressure = 0, raceway_flow = 0;  ///< Pa
  RacewayTest raceway_state = RacewayTest::uniaxial;
};

template <class Io> void each_member(Io &&io, const RatingInputs &record)
{
  const auto &[dynamic_rating, static_rating, viscosity_ratio, contamination, roller_diameter, pitch_diameter,
               bore, outside_diameter, arrangement, cup_angle, yield_pressure, raceway_flow, raceway_state] =
      record;
  io("dynamic_rating", dynamic_rating);
  io("static_rating", static_rating);
  io("viscosity_ratio", viscosity_ratio);
  io("contamination", contamination);
  io("roller_diameter", roller_diameter);
  io("pitch_diameter", pitch_diameter);
  io("bore", bore);
  io("outside_diameter", outside_diameter);
  io("arrangement", arrangement);
  io("cup_angle", cup_angle);
  io("yield_pressure", yield_pressure);
  io("raceway_flow", raceway_flow);
  io("raceway_state", raceway_state);
}
RatingInputs inputs_of_rating(const RollerBearing &bearing);

/// An oil film without what is not there.
/// @param least_speed  the speed at which it begins to carry: that depends on the roughness
OilFilmBearing film_as_read(OilFilmBearing bearing, bool least_speed);

/// Radial load of one bearing of a stand, and which bearing it is.
struct SeatLoadInputs {
  std::string bearing;
  double bearing_load = not_given;                               ///< N; given, nothing else is read
  std::vector<LoadInputs> rolling;                               ///< none or one: of the pass
  std::array<double, 2> diameters     = {not_given, not_given};  ///< m, of both rolls, with an offset alone
  std::array<double, 2> bending_force = {not_given, not_given};  ///< N
  double axis_offset                  = not_given;               ///< m
};

template <class Io> void each_member(Io &&io, const SeatLoadInputs &record)
{
  const auto &[bearing, bearing_load, rolling, diameters, bending_force, axis_offset] = record;
  io("bearing", bearing);
  io("bearing_load", bearing_load);
  io("rolling", rolling);
  io("diameters", diameters);
  io("bending_force", bending_force);
  io("axis_offset", axis_offset);
}
/// @param contact  "upper" or "lower"
SeatLoadInputs inputs_of_seat_load(const FourHigh &stand, bool backup, const std::string &contact,
                                   std::size_t pass);

/// One of the four places of a bearing under the load of a pass, along or across it.
/// @param place  0 .. 3: upper backup roll, upper work roll, lower work roll, lower backup roll
/// @returns  text of its inputs
struct SeatReading {
  bool across      = false;
  bool least_speed = false;  ///< of an oil film
  bool rating      = false;  ///< of rollers
};
std::string text_of_seat(const FourHigh &stand, std::size_t place, std::size_t pass, const SeatReading &reading);

/// The seat of the chocks of a roll in the housing, for motion along the pass line.
/// @returns  its text; empty where no stand is drawn and of a backup roll
std::string text_of_chock_seat(const CaseSpec &spec, RollPlace roll);

/// Results of kind "bearing".
struct BearingCaseReading {
  bool rating = false, least_speed = false;
  bool motion = false;  ///< the mass that swings on the curve of the bearing
};
std::string text_of_bearing_case(const BearingCase &spec, const BearingCaseReading &reading);

/// A bearing by the model of its case: FE law or a formula, elastic or rigid rings.
KeyList bearing_keys(const RollerBearing &bearing);
/// In addition, the keys that only ratings and life of a bearing read.
KeyList rating_keys(const RollerBearing &bearing);
/// The cup angle at which roller, cup and cone share one apex.
KeyList closing_angle_keys(const RollerBearing &bearing);
/// Radial load of one bearing in a stand, and which bearing it is.
/// @param contact  "upper" or "lower"
KeyList seat_load_keys(MovingKeys &keys, bool backup, const std::string &contact, std::size_t p);
/// Kzc1 .. Kzc4 of a stand, i = 0 .. 3, under the load of a pass.
KeyList seat_keys(MovingKeys &keys, std::size_t i, std::size_t p, const SeatReading &reading = {});
/// The closing cup angle of one of them.
KeyList seat_closing_angle_keys(MovingKeys &keys, std::size_t i);
/// Kzc.* of kind "bearing".
KeyList bearing_case_keys(MovingKeys &keys, const BearingCaseReading &reading = {});
KeyList bearing_case_closing_angle_keys(MovingKeys &keys);

/// The keys behind the seat of the chocks of a roll.
KeyList chock_seat_keys(MovingKeys &keys, RollPlace roll);
}  // namespace mill
