#pragma once
#include "app/run/run_context.h"
#include "core/model/oil_film_bearing.h"
#include "reduce/bearing/oil_film/film_numbers.h"
#include <optional>

namespace mill {
/// What is asked of an oil-film bearing.
struct OilFilmQuestion {
  OilFilmBearing bearing;
  bearing::OilFilmLoad load;
  std::vector<double> loads, speeds;  ///< N, rad/s: of the curves, ascending; may be empty
  std::string speed_key;              ///< of the case, "load.speed", "pass.0.speed"
  double surface_radius = not_given;  ///< m, speeds are those of the surface of this roll; absent: in rpm
};

/// One oil-film bearing at its working load and speed, and over both; a point of a curve without a film is empty.
struct OilFilmStudy {
  OilFilmQuestion question;
  bearing::FilmNumbers numbers;
  std::vector<std::optional<bearing::OilFilmState>> by_load, by_speed;
};

/// "65.9 rpm", or "0.5 m/s" of a roll's surface.
StatedQuantity shown_speed(const OilFilmQuestion &question, double speed);
std::string speed_text(const OilFilmQuestion &question, double speed);

/// @throws InputError  no film carries at this speed: with the speed at which one does
OilFilmStudy study_oil_film(RunContext &run, const OilFilmQuestion &question);
}  // namespace mill
