#include "core/base/units.h"
#include "core/case/stand_reader.h"
#include "core/case/stand_rows.h"
#include "core/model/case.h"
#include <cmath>
#include <fmt/format.h>

// [bearing.*] of type oil-film: rows, reading, checks.
namespace mill {
const std::vector<Field<OilFilmBearing>> &oil_film_rows()
{
  using T = OilFilmBearing;
  constexpr Range any;
  static const std::vector<Field<T>> rows{
      {"type", &T::type, "oil-film", any, required, "oil-film", "a sleeve that turns in a bush, parted by oil"},
      {"diameter", &T::diameter, "mm", {5, 5000}, required, "950 mm", "of the sleeve"},
      {"length", &T::length, "mm", {1, 5000}, required, "700 mm", "of the film along the axis"},
      {"clearance",
       &T::clearance,
       "mm",
       {1e-4, 20},
       required,
       "0.45 mm",
       "radial: radius of the bush less that of the sleeve"},
      {"viscosity",
       &T::viscosity,
       "degC, Pa s",
       {1e-5, 1000},
       required,
       "[[\"40 degC\", \"0.400 Pa s\"], [\"100 degC\", \"0.027 Pa s\"]]",
       "dynamic viscosity at two temperatures, by Walther's law between and beyond them; the same value twice is "
       "an oil that does not thin"},
      {"inlet_temperature", &T::inlet_temperature, "degC", {-20, 200}, 40, "40 degC", "of the oil that is fed"},
      {"oil_density", &T::oil_density, "kg/m3", {500, 2000}, 880, "880 kg/m3", "of the oil"},
      {"oil_heat", &T::oil_heat, "J/kg K", {500, 5000}, 2000, "2000 J/kg K", "specific heat of the oil"},
      {"heat_share",
       &T::heat_share,
       "1",
       {0, 1},
       1,
       "1",
       "share of the friction heat that the side flow removes; zero: the film stays at the inlet temperature"},
      {"warming_share",
       &T::warming_share,
       "1",
       {0, 1},
       0.5,
       "0.5",
       "temperature of the film from inlet (0) to outlet (1)"},
      {"pressure_viscosity",
       &T::pressure_viscosity,
       "1/GPa",
       {0, 100},
       0,
       "0 1/GPa",
       "Barus' exponent of the viscosity over the pressure; mineral oils 15 .. 25"},
      {"roughness",
       &T::roughness,
       "um",
       {0, 100},
       1,
       "1 um",
       "rms of both surfaces together; a film carries from three times of it"},
      {"bush_thickness",
       &T::bush_thickness,
       "mm",
       {0.01, 500},
       absent,
       "3 mm",
       "of the layer of the bush that deflects under pressure; when absent it is rigid"},
      {"bush_modulus", &T::bush_modulus, "GPa", {0.001, 1000}, 52, "52 GPa", "of that layer, babbitt"},
      {"bush_poisson_ratio", &T::bush_poisson, "1", {0, 0.49}, 0.35, "0.35", "of that layer"},
      {"sleeve_thickness",
       &T::sleeve_thickness,
       "mm",
       {0.01, 1000},
       absent,
       "40 mm",
       "of the sleeve; when absent it is rigid"},
      {"sleeve_modulus", &T::sleeve_modulus, "GPa", {0.001, 1000}, 210, "210 GPa", "of the sleeve"},
      {"sleeve_poisson_ratio", &T::sleeve_poisson, "1", {0, 0.49}, 0.3, "0.3", "of the sleeve"},
      {"grooves",
       &T::grooves,
       "count",
       {0, 2},
       0,
       "0",
       "inlet grooves in the bush, a second one opposite the first"},
      {"groove_angle",
       &T::groove_angle,
       "deg",
       {-360, 360},
       -90,
       "-90 deg",
       "of the middle of the first one from the load, in the direction of rotation"},
      {"groove_width", &T::groove_width, "deg", {1, 170}, 30, "30 deg", "around"},
      {"groove_length", &T::groove_length, "1", {0.05, 0.95}, 0.8, "0.8", "of the length of the film"},
      {"feed_pressure", &T::feed_pressure, "bar", {0, 1000}, 1, "1 bar", "in the grooves, above that at the ends"},
  };
  return rows;
}

bool is_oil_film(const Node::Entry &entry)
{
  const Node::Entry *type = entry.value.find("type");
  return type && type->value.kind == Node::Kind::text && type->value.text == "oil-film";
}

std::vector<OilFilmBearing> read_oil_films(const Node &root, Reading &reading)
{
  std::vector<OilFilmBearing> films;
  const Node::Entry *all = root.find("bearing");
  if (!all || all->value.kind != Node::Kind::table)
    return films;
  for (const Node::Entry &entry : all->value.entries) {
    if (!is_oil_film(entry))
      continue;
    OilFilmBearing film;
    film.name = entry.key;
    const Section section{&entry.value, "bearing." + entry.key};
    read_and_echo(section, "[bearing." + key_text(entry.key) + "]", oil_film_rows(), film, reading);
    check_oil_film(film, reading);
    films.push_back(film);
  }
  return films;
}

void check_oil_film(const OilFilmBearing &film, Reading &reading)
{
  const auto key = [&](const char *k) { return "bearing." + film.name + "." + k; };
  if (reading.usable({key("clearance"), key("diameter")}) && film.clearance > 0.01 * film.diameter)
    contradict(
        reading, key("clearance"),
        fmt::format("is more than a hundredth of the diameter; the film of such a bearing is not thin: at most {}",
                    millimetres(0.01 * film.diameter)),
        {key("diameter")});
  if (reading.usable({key("clearance"), key("roughness")}) && film.clearance <= 6 * film.roughness)
    contradict(reading, key("roughness"), "leaves no room for a film in this clearance", {key("clearance")});
  if (reading.usable({key("viscosity"), key("oil_density")})) {
    if (film.viscosity.size() != 2)
      contradict(reading, key("viscosity"), "needs two temperatures", {});
    else if (film.viscosity[0][1] < film.viscosity[1][1])
      contradict(reading, key("viscosity"), "rises with the temperature; an oil thins", {});
    else if (1e6 * film.viscosity[1][1] / film.oil_density < 0.4)
      contradict(reading, key("viscosity"), "is below 0.4 mm2/s over the density, where Walther's law ends",
                 {key("oil_density")});
  }
}

void check_oil_film_load(const Node &root, const BearingCase &spec, Reading &reading)
{
  const OilFilmBearing *film = oil_film_of(spec.oil_films, spec.load.bearing);
  const auto is_given = [&](const char *key) { return reading.places.count(std::string("load.") + key) > 0; };
  const auto &speeds  = spec.load.speeds;
  if (!film) {
    for (const char *key : {"tilt_across", "speeds"})
      if (is_given(key) && reading.usable({"load.bearing"}) && (spec.load.tilt_across != 0 || key[0] == 's'))
        contradict(reading, std::string("load.") + key, "belongs to an oil-film bearing; leave it out",
                   {"load.bearing"});
    return;
  }
  for (const auto &[key, value] :
       {std::pair("axial", spec.load.axial), std::pair("cage_angle", spec.load.cage_angle),
        std::pair("axial_displacement", spec.load.axial_displacement), std::pair("moment", spec.load.moment)})
    if (is_given(key) && value != 0)
      contradict(reading, std::string("load.") + key, "belongs to a roller bearing; leave it out",
                 {"load.bearing"});
  if (const Node::Entry *model = root.find("model"))
    reading.add(model->key_place,
                fmt::format("[model] belongs to a roller bearing; bearing.{} is an oil film", film->name));
  if (std::isfinite(spec.motion.mass))
    contradict(reading, "dynamics.mass", "swings on a roller bearing's curve; leave it out", {"load.bearing"});
  if (!reading.usable({"load.speed"}))
    return;
  if (!(spec.load.speed > 0))
    reading.add(
        reading.place(is_given("speed") ? "load.speed" : "load.bearing"),
        fmt::format("bearing.{} is an oil film, which carries no load at rest; load.speed needs a speed of the "
                    "sleeve, for example \"60 rpm\"",
                    film->name));
  if (!std::isnan(speeds[0]) && !(speeds[1] > speeds[0]))
    contradict(reading, "load.speeds", "does not increase; the smaller speed comes first", {});
}

void check_oil_films_of_stand(const FourHigh &stand, Reading &reading)
{
  if (oil_film_of(stand.oil_films, stand.work_roll.bearing))
    contradict(reading, "work_roll.bearing", "is an oil film; oil films carry backup rolls", {});
  const OilFilmBearing *film = oil_film_of(stand.oil_films, stand.backup_roll.bearing);
  if (!film)
    return;
  for (std::size_t p = 0; p < stand.passes.size(); ++p)
    if (const std::string key = fmt::format("pass.{}.speed", p);
        std::isnan(stand.passes[p].speed) && reading.usable({key}))
      reading.add(stand.passes[p].place,
                  fmt::format("pass \"{}\" gives no speed; bearing.{} of the backup rolls is an oil film, which "
                              "carries no load at rest; add for example speed = \"5 m/s\"",
                              stand.passes[p].name, film->name));
  if (reading.usable({"bearing." + film->name + ".diameter", "backup_roll.barrel_diameter"}) &&
      film->diameter >= stand.backup_roll.barrel_diameter)
    contradict(reading, "bearing." + film->name + ".diameter", "is not smaller than the barrel it carries",
               {"backup_roll.barrel_diameter"});
}
}  // namespace mill
