#pragma once
#include "app/stages/bearing/oil_film_study.h"
#include "core/model/bearing_case.h"

namespace mill {
/// Stiffness of one bearing along its load, k_xx, or across it, k_yy, with error and checks.
Parameter film_stiffness(const OilFilmStudy &study, const std::vector<std::string> &inputs, bool across = false);

/// bearing.NAME.film.*: eccentricity, attitude, films, pressure, temperature, losses, flow, k and b.
/// @param inputs         keys behind all of them but the least speed
/// @param of_least_speed  keys behind that
void add_oil_film_results(RunContext &run, const OilFilmStudy &study, const std::vector<std::string> &inputs,
                          const std::vector<std::string> &of_least_speed);

/// curves/bearing-NAME*.csv: over load, over speed, pressure.
void write_oil_film(RunContext &run, const OilFilmStudy &study);

/// What the reader of the report has to know: damping and the chain, cross terms, temperature.
/// @param in_chain  whether a chain of masses takes its stiffness
void note_oil_film(RunContext &run, const OilFilmStudy &study, bool in_chain);

/// kind = "bearing" with an oil film: all of it.
void solve_oil_film_case(RunContext &run, const BearingCase &spec, const OilFilmBearing &bearing);
}  // namespace mill
