#pragma once
#include "core/case/kinds.h"
#include "core/case/pass_inputs.h"
#include "core/case/roller_bearing_inputs.h"
#include "core/model/bearing_case.h"
#include "core/model/four_high.h"
#include "core/model/oil_film_bearing.h"
#include "core/model/roll_kind.h"
#include "core/records/key_list.h"
#include <string>
#include <vector>

// What the bearing stages read of a case; as core/case/contact_inputs.h.
namespace mill {
class MovingKeys;

/// An oil film without what is not there.
/// @param least_speed  the speed at which it begins to carry: that depends on the roughness
OilFilmBearing film_as_read(OilFilmBearing bearing, bool least_speed);

/// Radial load of one bearing of a stand, and which bearing it is.
struct SeatLoadInputs {
  std::string bearing;
  double load = not_given;          ///< N, under a rolling force of 1 MN
  std::vector<LoadInputs> rolling;  ///< none or one: of the pass, where the load follows it
};

template <class Io> void each_member(Io &&io, const SeatLoadInputs &record)
{
  const auto &[bearing, load, rolling] = record;
  io("bearing", bearing);
  io("load", load);
  io("rolling", rolling);
}
/// @param contact  "upper" or "lower"
SeatLoadInputs inputs_of_seat_load(const FourHigh &stand, bool backup, const std::string &contact,
                                   std::size_t pass);

/// One of the four places of a bearing under the load of a pass.
/// @param place  0 .. 3: upper backup roll, upper work roll, lower work roll, lower backup roll
/// @returns  text of its inputs
std::string text_of_seat(const FourHigh &stand, std::size_t place, std::size_t pass,
                         const BearingReading &reading);

/// The seat of the chocks of a roll in the housing, for motion along the pass line.
/// @returns  its text; empty where no stand is drawn and of a backup roll
std::string text_of_chock_seat(const CaseSpec &spec, RollPlace roll);

/// Results of kind "bearing".
std::string text_of_bearing_case(const BearingCase &spec, const BearingReading &reading);

/// A bearing by itself, under whatever load of this form: keys of its section alone.
KeyList bearing_keys(const RollerBearing &bearing, const BearingReading &reading = {}, const LoadForm &form = {});
/// The cup angle at which roller, cup and cone share one apex.
KeyList closing_angle_keys(const RollerBearing &bearing);
/// Kzc1 .. Kzc4 of a stand, i = 0 .. 3, under the load of a pass.
KeyList seat_keys(MovingKeys &keys, std::size_t i, std::size_t p, const BearingReading &reading = {});
/// The closing cup angle of one of them.
KeyList seat_closing_angle_keys(MovingKeys &keys, std::size_t i);
/// A result of kind "bearing".
KeyList bearing_case_keys(MovingKeys &keys, const BearingReading &reading = {});
KeyList bearing_case_closing_angle_keys(MovingKeys &keys);

/// The keys behind the seat of the chocks of a roll.
KeyList chock_seat_keys(MovingKeys &keys, RollPlace roll);
}  // namespace mill
