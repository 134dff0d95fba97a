#include "app/stages/bearing/oil_film_results.h"
#include "app/run/curve_files.h"
#include "core/base/files.h"
#include "core/records/csv.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_bearing.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using bearing::OilFilmState;

bool is_plain(const OilFilmQuestion &q)
{
  return bearing::layer_compliance(q.bearing) == 0 && q.load.tilt.norm() == 0 && q.bearing.grooves == 0 &&
         q.bearing.pressure_viscosity == 0;
}

std::string film_model(const OilFilmQuestion &q)
{
  std::string name = "Reynolds equation with rupture, two grids (29.2)";
  const auto add   = [&](const bool has, const char *what) { name += has ? what : ""; };
  add(bearing::layer_compliance(q.bearing) > 0, ", elastic bush and sleeve");
  add(q.bearing.pressure_viscosity > 0, ", viscosity over pressure");
  add(q.bearing.grooves > 0, ", inlet grooves");
  add(q.load.tilt.norm() > 0, ", tilted sleeve");
  return name;
}

Parameter plain_film(const OilFilmStudy &s, const std::vector<std::string> &inputs)
{
  Parameter p;
  p.method = film_model(s.question);
  p.at = {"{} on one bearing, {}", {{s.question.load.load, "kN"}, shown_speed(s.question, s.question.load.speed)}};
  p.inputs = inputs;
  return p;
}

const char *rigid_note(const OilFilmQuestion &q)
{
  return is_plain(q) ? "" : "rigid and aligned, no grooves, viscosity without pressure";
}

constexpr const char *parabola_name = "film with a parabola along the bearing (29.15)";
constexpr const char *short_name    = "short bearing (29.13)";

// An entry of stiffness or damping with its error.
Parameter film_entry(const OilFilmStudy &s, const std::vector<std::string> &inputs,
                     const Eigen::Matrix2d OilFilmState::*matrix, const int i, const int j)
{
  Parameter p      = plain_film(s, inputs);
  p.value          = (s.numbers.solution.at.*matrix)(i, j);
  p.error_estimate = (s.numbers.error.*matrix)(i, j);
  return p;
}

void add_matrices(RunContext &run, const OilFilmStudy &s, const std::vector<std::string> &inputs)
{
  const std::string &name            = s.question.bearing.name;
  const bearing::SimplerFilms &other = s.numbers.simpler;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      Parameter k = film_entry(s, inputs, &OilFilmState::stiffness, i, j);
      k.unit      = row::film::stiffness[i][j]->unit;
      k.checks    = {{parabola_name, other.stiffness(i, j), rigid_note(s.question)}};
      k.method += i == j ? "" : ", force along the first axis by motion along the second";
      run.results.add(row::film::stiffness[i][j]->of(name), k);
      Parameter b = film_entry(s, inputs, &OilFilmState::damping, i, j);
      b.unit      = row::film::damping[i][j]->unit;
      b.checks    = {{"short bearing (29.14)", other.short_damping(i, j), "L/D -> 0"}};
      run.results.add(row::film::damping[i][j]->of(name), b);
    }
}

void add_layers(RunContext &run, const OilFilmStudy &s, const std::vector<std::string> &inputs)
{
  const OilFilmState &state = s.numbers.solution.at;
  const std::string &name   = s.question.bearing.name;
  if (!std::isfinite(state.layer_stiffness))
    return;
  Parameter p      = plain_film(s, inputs);
  p.unit           = "N/m";
  p.value          = state.layer_stiffness;
  p.method         = "layers of bush and sleeve under the film's pressure, W^2/(C int p^2 dA), (29.16)";
  p.error_estimate = s.numbers.error.layer_stiffness;
  run.results.add(row::film::layer_stiffness.of(name), p);
  if (const auto both = bearing::series_stiffness(s.question.bearing, s.question.load, state)) {
    Parameter series = plain_film(s, inputs);
    series.unit      = "N/m";
    series.method    = "rigid film along the load and layers as plain springs in series";
    series.value     = *both;
    series.checks    = {{"film and layers solved together", state.stiffness(0, 0), "the layers reshape the film"}};
    run.results.add(row::film::series_stiffness.of(name), series);
  } else
    run.assume(
        fmt::format("bearing.{}: between rigid surfaces no film carries this load; plain springs in series are "
                    "left out",
                    name));
}
}  // namespace

Parameter film_stiffness(const OilFilmStudy &s, const std::vector<std::string> &inputs, const bool across)
{
  const int axis = across ? 1 : 0;
  Parameter p    = film_entry(s, inputs, &OilFilmState::stiffness, axis, axis);
  p.unit         = "N/m";
  p.method += across ? ", across the load" : ", along the load";
  p.checks = {{parabola_name, s.numbers.simpler.stiffness(axis, axis), rigid_note(s.question)}};
  return p;
}

void add_oil_film_results(RunContext &run, const OilFilmStudy &s, const std::vector<std::string> &inputs,
                          const std::vector<std::string> &of_least_speed)
{
  const std::string &name            = s.question.bearing.name;
  const OilFilmState &state          = s.numbers.solution.at;
  const bearing::SimplerFilms &other = s.numbers.simpler;
  const std::string note             = rigid_note(s.question);
  const auto add = [&](const RowOf<1> &row, double OilFilmState::*number, std::vector<Check> checks = {}) {
    Parameter p      = plain_film(s, inputs);
    p.value          = state.*number;
    p.unit           = row.unit;
    p.error_estimate = s.numbers.error.*number;
    p.checks         = std::move(checks);
    run.results.add(row.of(name), p);
  };
  add(row::film::eccentricity, &OilFilmState::eccentricity,
      {{parabola_name, other.eccentricity, note}, {short_name, other.short_eccentricity, "L/D -> 0"}});
  add(row::film::attitude, &OilFilmState::attitude,
      {{parabola_name, other.attitude, note}, {short_name, other.short_attitude, "L/D -> 0"}});
  add(row::film::minimum_film, &OilFilmState::least_film, {{parabola_name, other.least_film, note}});
  add(row::film::peak_pressure, &OilFilmState::peak_pressure, {{short_name, other.short_peak, "L/D -> 0"}});
  add(row::film::power_loss, &OilFilmState::power_loss,
      {{"full film of the parabola's eccentricity", other.full_loss, note},
       {"oil in streamers behind the rupture", state.power_streamers, "part of the error"}});
  add(row::film::friction_torque, &OilFilmState::friction_torque,
      {{"full film of the parabola's eccentricity", other.full_friction, note}});
  add(row::film::side_flow, &OilFilmState::side_flow,
      {{"short bearing, 2 e R c w L/2", other.short_flow, "L/D -> 0"}});
  const OilFilmBearing &b = s.question.bearing;
  add(row::film::temperature, &OilFilmState::temperature,
      {{"by full film and short bearing", b.inlet_temperature + b.warming_share * other.warming, note}});
  add(row::film::outlet_temperature, &OilFilmState::outlet_temperature,
      {{"by full film and short bearing", b.inlet_temperature + other.warming, note}});
  add(row::film::viscosity, &OilFilmState::viscosity);
  add(row::film::sommerfeld, &OilFilmState::sommerfeld, {{parabola_name, other.sommerfeld, note}});
  add_matrices(run, s, inputs);
  Parameter still      = plain_film(s, inputs);
  still.unit           = "N/m";
  still.value          = s.numbers.free.value;
  still.error_estimate = s.numbers.free.error;
  still.method += ", along the load, free to move across";
  still.checks = {{"difference of two loads", s.numbers.free.by_loads, ""}};
  run.results.add(row::film::k_static.of(name), still);
  Parameter least = plain_film(s, of_least_speed);
  least.unit      = "Hz";
  least.value     = s.numbers.least_speed / (2 * M_PI);
  least.method += ", least speed of the sleeve at which a film carries this load";
  run.results.add(row::film::least_speed.of(name), least);
  if (s.question.load.tilt.norm() > 0)
    add(row::film::tilting_stiffness, &OilFilmState::tilting_stiffness);
  add_layers(run, s, inputs);
}

void note_oil_film(RunContext &run, const OilFilmStudy &s, const bool in_chain)
{
  const OilFilmState &state = s.numbers.solution.at;
  const std::string &name   = s.question.bearing.name;
  const double locks        = state.stiffness(0, 0) / (2 * M_PI * state.damping(0, 0));
  const std::string film =
      fmt::format("bearing.{}: the film resists motion along the load by {:.4g} kN/mm and {:.4g} kN s/mm; above "
                  "{:.3g} Hz its damping is more than its stiffness",
                  name, state.stiffness(0, 0) / 1e6, state.damping(0, 0) / 1e6, locks);
  run.assume(film + (in_chain
                         ? ". Stiffnesses at rest (K2, K6, mill modulus) have the spring alone; modes, frequency "
                           "response and critical speed have spring and damper at the frequency of the gap "
                           "mode (29.18)"
                         : ""));
  run.assume(
      fmt::format("bearing.{}: motion across the load moves the force along it by k_xy = {:.4g} kN/mm, the other "
                  "way round by k_yx = {:.4g} kN/mm{}",
                  name, state.stiffness(0, 1) / 1e6, state.stiffness(1, 0) / 1e6,
                  in_chain ? "; the chain takes neither" : ""));
  run.assume(fmt::format(
      "bearing.{}: behind the rupture the friction is computed as if the gap were full of oil; with streamers "
      "the loss would be {:.3g} kW in place of {:.3g} kW",
      name, state.power_streamers / 1e3, state.power_loss / 1e3));
  if (state.temperature > 273.15 + 90)
    run.warn({WarningId::oil_film_hot,
              "bearing " + name,
              fmt::format("the film is at {:.3g} degC", state.temperature - 273.15),
              "babbitt softens and oil ages above 90 degC",
              "",
              {result_name({"bearing", name})}});
}
}  // namespace mill
