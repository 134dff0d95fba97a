#include "core/case/bearing_inputs.h"
#include "core/case/moving_keys.h"
#include "core/case/stand_rows.h"
#include "core/records/contact_name.h"
#include "core/records/record_text.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace mill {
namespace {
template <class Bearing>
const Bearing *bearing_named(const std::vector<Bearing> &bearings, const std::string &name)
{
  const auto match =
      std::find_if(bearings.begin(), bearings.end(), [&](const Bearing &b) { return b.name == name; });
  return match == bearings.end() ? nullptr : &*match;
}

std::string word_or_none(const std::optional<BearingType> &type)
{
  return type ? word_of(*type) : "";
}

// Sets the members that are not read back to those of a bearing that does not give them.
struct Unread {
  RollerBearing &bearing;
  RollerBearing none = {};
  template <class... Members> void operator()(const bool unread, const Members... members)
  {
    if (unread)
      ((bearing.*members = none.*members), ...);
  }
};

// Every pass may make the heaviest load of a bearing, for which its roller is meshed.
std::vector<SeatLoadInputs> loads_of_the_mesh(const FourHigh &stand, const RollerBearing &bearing)
{
  std::vector<SeatLoadInputs> loads;
  for (std::size_t pass = 0; pass < stand.passes.size(); ++pass)
    for (const bool backup : {false, true})
      for (const char *contact : {"upper", "lower"})
        if ((backup ? stand.backup_roll : stand.work_roll).bearing == bearing.name)
          loads.push_back(inputs_of_seat_load(stand, backup, contact, pass));
  return loads;
}
}  // namespace

BearingInputs inputs_of_bearing(const RollerBearing &given, const BearingReading &reading)
{
  using B = RollerBearing;
  BearingInputs inputs{word_or_none(given.type), given, given.designation, given.catalogue};
  if (!given.estimated.empty())
    inputs.ratings = {given.dynamic_rating, given.static_rating};
  const bool fe = given.roller_law == OneRollerLaw::fe, elastic = given.rings == RingBodies::elastic,
             drawn   = fe || elastic;
  const bool three   = given.profile == RollerProfile::three_parameter;
  const bool rounded = given.profile == RollerProfile::log || given.profile == RollerProfile::lundberg || three;
  const bool tapered = given.type == BearingType::four_row_tapered;
  const bool sized   = drawn || rounded || given.roller_law == OneRollerLaw::elastic;
  Unread unread{inputs.bearing};
  // Raceway pressures are compared with the yield pressure afterwards.
  unread(true, &B::yield_pressure, &B::rib_angle);
  unread(given.profile == RollerProfile::none && !fe && !reading.across && !reading.askew, &B::slices);
  unread(given.profile != RollerProfile::table, &B::profile_table);
  unread(!(given.profile == RollerProfile::crown || three), &B::crown_drop);
  unread(!three, &B::profile_share);
  unread(!rounded, &B::profile_load);
  unread(!std::isnan(given.end_play) || !std::isnan(given.preload), &B::radial_clearance);
  unread(!fe, &B::roller_total_length);
  unread(!drawn || !tapered, &B::roller_cone_angle);
  unread(!sized && given.profile != RollerProfile::iso, &B::roller_diameter);
  unread(!sized, &B::youngs_modulus, &B::poisson_ratio);
  // Without a pitch diameter these two give it.
  unread(!sized && !(reading.askew && std::isnan(given.pitch_diameter)), &B::bore, &B::outside_diameter);
  unread(!sized && !reading.askew, &B::pitch_diameter);
  unread(!tapered, &B::cup_angle, &B::end_play, &B::preload);
  unread(!drawn && !reading.askew, &B::width);
  unread((!drawn || !tapered) && !reading.askew, &B::arrangement);
  unread(!elastic, &B::chock);
  unread(!elastic || given.chock == ChockForm::rigid, &B::chock_width, &B::chock_height, &B::chock_length);
  unread(!elastic || given.chock != ChockForm::block, &B::chock_support_width, &B::chock_support_gap);
  return inputs;
}

RatingInputs inputs_of_rating(const RollerBearing &b)
{
  RatingInputs inputs{b.dynamic_rating, b.static_rating, b.viscosity_ratio,  b.contamination, b.roller_diameter,
                      b.pitch_diameter, b.bore,          b.outside_diameter, b.arrangement,   not_given,
                      b.yield_pressure, b.raceway_flow,  b.raceway_state};
  if (b.type == BearingType::four_row_tapered)
    inputs.cup_angle = b.cup_angle;
  return inputs;
}

OilFilmBearing film_as_read(OilFilmBearing film, const bool least_speed)
{
  const OilFilmBearing none;
  if (!least_speed)
    film.roughness = none.roughness;
  if (std::isnan(film.bush_thickness)) {
    film.bush_modulus = none.bush_modulus;
    film.bush_poisson = none.bush_poisson;
  }
  if (std::isnan(film.sleeve_thickness)) {
    film.sleeve_modulus = none.sleeve_modulus;
    film.sleeve_poisson = none.sleeve_poisson;
  }
  if (film.grooves == 0) {
    film.groove_angle  = none.groove_angle;
    film.groove_width  = none.groove_width;
    film.groove_length = none.groove_length;
    film.feed_pressure = none.feed_pressure;
  }
  return film;
}

SeatLoadInputs inputs_of_seat_load(const FourHigh &stand, const bool backup, const std::string &contact,
                                   const std::size_t pass)
{
  const Roll &roll    = backup ? stand.backup_roll : stand.work_roll;
  const auto &bending = stand.work_roll.bending_force;
  const double axis_offset =
      (is_contact(contact, ContactName::upper) ? stand.upper_contact : stand.lower_contact).axis_offset;
  SeatLoadInputs inputs;
  inputs.bearing      = roll.bearing;
  inputs.bearing_load = roll.bearing_load;
  if (!std::isnan(roll.bearing_load))
    return inputs;
  if (backup || bending[0] + bending[1] == 0 || axis_offset != 0)
    inputs.rolling = {inputs_of_load(stand.passes[pass])};
  if (axis_offset != 0)
    inputs.diameters = {stand.work_roll.barrel_diameter, stand.backup_roll.barrel_diameter};
  inputs.bending_force = bending;
  inputs.axis_offset   = axis_offset;
  return inputs;
}

std::string text_of_seat(const FourHigh &stand, const std::size_t place, const std::size_t pass,
                         const SeatReading &reading)
{
  const bool backup = place == 0 || place == 3;
  const Roll &roll  = backup ? stand.backup_roll : stand.work_roll;
  const auto load   = inputs_of_seat_load(stand, backup, place < 2 ? "upper" : "lower", pass);
  if (const OilFilmBearing *film = bearing_named(stand.oil_films, roll.bearing))
    return record_text(load, stand.passes[pass].speed, roll.barrel_diameter,
                       film_as_read(*film, reading.least_speed));
  const RollerBearing *bearing = bearing_named(stand.bearings, roll.bearing);
  if (!bearing)
    return record_text(load);
  std::string text = record_text(load, inputs_of_bearing(*bearing, {reading.across, false}));
  if (bearing->roller_law == OneRollerLaw::fe)
    text += record_text(stand.work_roll.bearing, stand.backup_roll.bearing, loads_of_the_mesh(stand, *bearing));
  if (reading.rating)  // life in hours at the speed of the first pass
    text += record_text(inputs_of_rating(*bearing), roll.barrel_diameter, stand.passes[0].speed);
  return text;
}

std::string text_of_chock_seat(const CaseSpec &spec, const RollPlace roll)
{
  const auto *stand = std::get_if<FourHigh>(&spec);
  if (!stand || !is_work_roll(roll))
    return "";
  const double stiffness = stand->frame.chock_to_housing_stiffness;
  const bool upper = roll == RollPlace::upper_work, yields = !std::isnan(stiffness);
  const double chock = upper ? stand->work_roll.chock_mass_upper : stand->work_roll.chock_mass_lower;
  return record_text(stiffness, yields ? chock : not_given);
}

std::string text_of_bearing_case(const BearingCase &spec, const BearingCaseReading &reading)
{
  const BearingLoad none;
  BearingLoad load = spec.load;
  load.samples     = none.samples;
  load.speeds      = none.speeds;
  if (const OilFilmBearing *film = bearing_named(spec.oil_films, load.bearing)) {
    load.axial = load.cage_angle = 0;
    load.axial_displacement = load.moment = not_given;
    load.loads                            = none.loads;
    return record_text(load, film_as_read(*film, reading.least_speed));
  }
  load.tilt_across             = none.tilt_across;
  const RollerBearing *bearing = bearing_named(spec.bearings, load.bearing);
  if (!bearing)
    return record_text(load);
  if (bearing->roller_law != OneRollerLaw::fe)  // the mesh is made for the largest of them
    load.loads = none.loads;
  std::string text = record_text(load, inputs_of_bearing(*bearing, {false, loaded_askew(load)}));
  if (reading.rating)
    text += record_text(inputs_of_rating(*bearing));
  if (reading.motion)
    text += record_text(spec.load.loads, spec.load.samples, spec.motion);
  return text;
}

namespace {
// Of one bearing, whatever case it belongs to.
template <class Text> KeyList keys_of_bearing(const RollerBearing &bearing, const Text &text)
{
  RollerBearing changed = bearing;
  CaseRows rows;
  rows.add("bearing." + bearing.name, bearing_rows(), changed);
  return rows.moving([&] { return text(changed); });
}

std::string text_of_closing_angle(const RollerBearing &b)
{
  const BearingInputs inputs = inputs_of_bearing(b);
  return record_text(closing_cup_angle(b), inputs.designation, inputs.catalogue, inputs.ratings);
}

// Of the bearing with this name, if there is one.
std::string text_of_closing_angle(const std::vector<RollerBearing> &bearings, const std::string &name)
{
  const RollerBearing *bearing = bearing_named(bearings, name);
  return record_text(name) + (bearing ? text_of_closing_angle(*bearing) : "");
}
}  // namespace

KeyList bearing_keys(const RollerBearing &bearing)
{
  return keys_of_bearing(bearing, [](const RollerBearing &b) { return record_text(inputs_of_bearing(b)); });
}

KeyList rating_keys(const RollerBearing &bearing)
{
  return keys_of_bearing(bearing, [](const RollerBearing &b) { return record_text(inputs_of_rating(b)); });
}

KeyList closing_angle_keys(const RollerBearing &bearing)
{
  return keys_of_bearing(bearing, [](const RollerBearing &b) { return text_of_closing_angle(b); });
}

KeyList seat_load_keys(MovingKeys &keys, const bool backup, const std::string &contact, const std::size_t p)
{
  return keys.of(fmt::format("load of seat {} {} {}", backup, contact, p), [&](const CaseSpec &spec) {
    return record_text(inputs_of_seat_load(std::get<FourHigh>(spec), backup, contact, p));
  });
}

KeyList seat_keys(MovingKeys &keys, const std::size_t i, const std::size_t p, const SeatReading &reading)
{
  const auto &stand = std::get<FourHigh>(keys.spec());
  const bool backup = i == 0 || i == 3;
  if ((backup ? stand.backup_roll : stand.work_roll).bearing.empty())  // all of its stiffnesses are given
    return keys_in("given", backup && stand.given.count("K_Zy") ? "K_Zy" : fmt::format("Kzc{}", i + 1));
  return keys.of(fmt::format("seat {} {} {} {} {}", i, p, reading.across, reading.least_speed, reading.rating),
                 [&](const CaseSpec &spec) { return text_of_seat(std::get<FourHigh>(spec), i, p, reading); });
}

KeyList seat_closing_angle_keys(MovingKeys &keys, const std::size_t i)
{
  const bool backup = i == 0 || i == 3;
  return keys.of(fmt::format("closing angle of seat {}", i), [&](const CaseSpec &spec) {
    const auto &stand = std::get<FourHigh>(spec);
    return text_of_closing_angle(stand.bearings, (backup ? stand.backup_roll : stand.work_roll).bearing);
  });
}

KeyList bearing_case_keys(MovingKeys &keys, const BearingCaseReading &reading)
{
  return keys.of(fmt::format("bearing {} {} {}", reading.rating, reading.least_speed, reading.motion),
                 [&](const CaseSpec &spec) { return text_of_bearing_case(std::get<BearingCase>(spec), reading); });
}

KeyList bearing_case_closing_angle_keys(MovingKeys &keys)
{
  return keys.of("closing angle", [](const CaseSpec &spec) {
    const auto &bearing = std::get<BearingCase>(spec);
    return text_of_closing_angle(bearing.bearings, bearing.load.bearing);
  });
}

KeyList chock_seat_keys(MovingKeys &keys, const RollPlace roll)
{
  return keys.of(std::string("chock seat of the ") + word_of(roll),
                 [&](const CaseSpec &spec) { return text_of_chock_seat(spec, roll); });
}
}  // namespace mill
