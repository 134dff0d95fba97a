#include "core/case/bearing_inputs.h"
#include "core/case/moving_keys.h"
#include "core/case/stand_rows.h"
#include "core/model/seat_load.h"
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
  const ContactSettings &of_contact =
      is_contact(contact, ContactName::upper) ? stand.upper_contact : stand.lower_contact;
  constexpr double force = 1e6;
  SeatLoadInputs inputs;
  inputs.bearing = (backup ? stand.backup_roll : stand.work_roll).bearing;
  inputs.load    = seat_load(stand, backup, of_contact, force).value;
  if (seat_load(stand, backup, of_contact, 2 * force).value != inputs.load)
    inputs.rolling = {inputs_of_load(stand.passes[pass])};
  return inputs;
}

std::string text_of_seat(const FourHigh &stand, const std::size_t place, const std::size_t pass,
                         const BearingReading &reading)
{
  const bool backup      = place == 0 || place == 3;
  const Roll &roll       = backup ? stand.backup_roll : stand.work_roll;
  const std::string load = record_text(inputs_of_seat_load(stand, backup, place < 2 ? "upper" : "lower", pass));
  if (const OilFilmBearing *film = bearing_named(stand.oil_films, roll.bearing))
    return load + record_text(stand.passes[pass].speed, roll.barrel_diameter,
                              film_as_read(*film, reading.asks == BearingAsks::least_speed));
  const RollerBearing *bearing = bearing_named(stand.bearings, roll.bearing);
  if (!bearing)
    return load;
  LoadedTexts on{*bearing, {}, record_text(roll.bearing), load};
  on.speed = record_text(roll.barrel_diameter, stand.passes[0].speed);  // of the first pass
  if (bearing->roller_law == OneRollerLaw::fe)
    on.mesh = record_text(stand.work_roll.bearing, stand.backup_roll.bearing, loads_of_the_mesh(stand, *bearing));
  return text_of_loaded_bearing(on, reading);
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

namespace {
std::string text_of_film_case(BearingLoad load, const OilFilmBearing &film, const BearingReading &reading)
{
  const BearingLoad none;
  load.samples = none.samples;
  load.speeds  = none.speeds;
  load.axial = load.cage_angle = 0;
  load.axial_displacement = load.moment = not_given;
  load.loads                            = none.loads;
  return record_text(load, film_as_read(film, reading.asks == BearingAsks::least_speed));
}

// The radial loads that a result reads: the working load, the curve, or both.
std::string text_of_radial(const BearingLoad &load, const BearingAsks asks)
{
  if (asks == BearingAsks::fitted_load)
    return record_text(load.loads, load.samples);
  if (asks == BearingAsks::motion)
    return record_text(load.radial, load.loads, load.samples);
  return record_text(load.radial);
}
}  // namespace

std::string text_of_bearing_case(const BearingCase &spec, const BearingReading &reading)
{
  const BearingLoad &load = spec.load;
  if (const OilFilmBearing *film = bearing_named(spec.oil_films, load.bearing))
    return text_of_film_case(load, *film, reading);
  const RollerBearing *bearing = bearing_named(spec.bearings, load.bearing);
  if (!bearing)
    return record_text(load);
  LoadedTexts on{*bearing, form_of(load), record_text(load.bearing), text_of_radial(load, reading.asks)};
  on.beside = record_text(load.axial, load.axial_displacement, load.tilt, load.moment);
  on.cage   = record_text(load.cage_angle);
  if (load.axial != 0 && std::isnan(load.axial_displacement))
    on.axial = record_text(load.axial, load.axial_displacement);
  on.speed = record_text(load.speed);
  on.mesh  = record_text(load.loads);  // it is made for the largest of them
  return text_of_loaded_bearing(on, reading) +
         (reading.asks == BearingAsks::motion ? record_text(spec.motion) : "");
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
  return record_text(closing_cup_angle(b)) + text_of_source(b);
}

// Of the bearing with this name, if there is one.
std::string text_of_closing_angle(const std::vector<RollerBearing> &bearings, const std::string &name)
{
  const RollerBearing *bearing = bearing_named(bearings, name);
  return record_text(name) + (bearing ? text_of_closing_angle(*bearing) : "");
}
}  // namespace

KeyList bearing_keys(const RollerBearing &bearing, const BearingReading &reading, const LoadForm &form)
{
  return keys_of_bearing(bearing, [&](const RollerBearing &b) {
    LoadedTexts on{b, form};
    on.axial = form.pushes ? "imposed" : "";
    return text_of_loaded_bearing(on, reading);
  });
}

KeyList closing_angle_keys(const RollerBearing &bearing)
{
  return keys_of_bearing(bearing, [](const RollerBearing &b) { return text_of_closing_angle(b); });
}

namespace {
std::string name_of(const BearingReading &reading)
{
  return fmt::format("{} {} {}", int(reading.asks), reading.in_time, reading.closed_form);
}
}  // namespace

KeyList seat_keys(MovingKeys &keys, const std::size_t i, const std::size_t p, const BearingReading &reading)
{
  const auto &stand = std::get<FourHigh>(keys.spec());
  const bool backup = i == 0 || i == 3;
  if ((backup ? stand.backup_roll : stand.work_roll).bearing.empty())  // all of its stiffnesses are given
    return keys_in("given", backup && stand.given.count("K_Zy") ? "K_Zy" : fmt::format("Kzc{}", i + 1));
  return keys.of(fmt::format("seat {} {} {}", i, p, name_of(reading)),
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

KeyList bearing_case_keys(MovingKeys &keys, const BearingReading &reading)
{
  return keys.of("bearing " + name_of(reading),
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
