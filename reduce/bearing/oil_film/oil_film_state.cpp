#include "reduce/bearing/oil_film/oil_film_state.h"
#include "core/base/errors.h"
#include "reduce/bearing/oil_film/viscosity.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace mill::bearing {
namespace {
// What turns the ratios of a film into SI.
struct Units {
  double pressure, force, flow, torque, clearance, speed;
};

Units units_of(const OilFilmBearing &b, const OilFilmLoad &load, const double viscosity)
{
  const double R = b.diameter / 2, half = b.length / 2, ratio = R / b.clearance;
  const double pressure = viscosity * load.speed * ratio * ratio;
  return {pressure,
          pressure * R * half,
          R * b.clearance * load.speed * half,
          viscosity * load.speed * R * R * ratio * half,
          b.clearance,
          load.speed};
}

FilmMesh mesh_of(const OilFilmLoad &load, const int fineness)
{
  return {60, load.tilt.norm() > 0 ? 4 : 6, fineness};
}

double viscosity_at(const OilFilmBearing &b, const double temperature)
{
  return oil_viscosity(b.viscosity, b.oil_density, temperature);
}

double layer_of(const double thickness, const double modulus, const double nu)
{
  return std::isfinite(thickness) ? thickness * (1 + nu) * (1 - 2 * nu) / (modulus * (1 - nu)) : 0;
}

double squared_pressure(const Film &film)
{
  const FilmGrid &g = film.grid();
  return g.mirror * (film.pressure().cwiseAbs2() * g.width).dot(g.z_width);
}

BalancedFilm balanced(const OilFilmBearing &b, const OilFilmLoad &load, const double temperature,
                      const int fineness, const BalancedFilm *near)
{
  const double viscosity = viscosity_at(b, temperature);
  const Units u          = units_of(b, load, viscosity);
  return balance_film(film_problem(b, load, viscosity), mesh_of(load, fineness), load.load / u.force, near);
}

// K, whole warming of the oil that leaves: theory.md (29.12).
double warming(const OilFilmBearing &b, const OilFilmLoad &load, const BalancedFilm &film,
               const double temperature)
{
  const Units u = units_of(b, load, viscosity_at(b, temperature));
  return b.heat_share * film.reactions.friction * u.torque * load.speed /
         (b.oil_density * b.oil_heat * film.reactions.side_flow * u.flow);
}

// A film and its temperature.
struct WarmFilm {
  BalancedFilm film;
  double temperature;
  double slope;  // of the misfit of the heat balance by the temperature
};

constexpr double heat_balanced = 1e-4;  // K
constexpr int most_heat_turns  = 60;

WarmFilm warm_film(const OilFilmBearing &b, const OilFilmLoad &load, const int fineness, const WarmFilm *near,
                   const BalancedFilm *neighbour)
{
  const bool warms = b.warming_share > 0 && b.heat_share > 0;
  WarmFilm w{{}, near ? near->temperature : b.inlet_temperature, near ? near->slope : -1};
  const auto misfit = [&](const double T) {
    w.film        = balanced(b, load, T, fineness, w.film.film ? &w.film : (near ? &near->film : neighbour));
    w.temperature = T;
    return warms ? b.inlet_temperature + b.warming_share * warming(b, load, w.film, T) - T : 0;
  };
  double T = w.temperature, g = misfit(T);
  double low = near ? 0 : T, high = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < most_heat_turns && std::abs(g) > heat_balanced; ++turn) {
    (g > 0 ? low : high) = T;
    double next          = T - g / w.slope;
    if (!(next > low && next < high))
      next = std::isfinite(high) ? (std::max(low, b.inlet_temperature) + high) / 2 : T + std::abs(g);
    const double before = g, from = T;
    for (;;)  // a film that is too hot to carry lies beyond the balance, unless it is hardly warmer
      try {
        T = next;
        g = misfit(T);
        break;
      } catch (const SolverError &) {
        if (!(T - from > 0.01))
          throw;
        high = T;
        next = from + (T - from) / 4;
      }
    if (T != from && (g - before) / (T - from) < -0.5)
      w.slope = (g - before) / (T - from);
  }
  if (!(std::abs(g) <= heat_balanced))
    throw SolverError({fmt::format("oil film of bearing {}: its warming does not settle", b.name),
                       fmt::format("{:.4g} K out of balance at {:.4g} K after {} steps", g, T, most_heat_turns),
                       "the viscosity falls so fast with the temperature that the film finds no balance",
                       "less speed, more clearance, a colder or a thinner oil", ""});
  return w;
}

OilFilmState state_of(const OilFilmBearing &b, const OilFilmLoad &load, const WarmFilm &w)
{
  const FilmReactions &r = w.film.reactions;
  OilFilmState s;
  s.viscosity                    = viscosity_at(b, w.temperature);
  const Units u                  = units_of(b, load, s.viscosity);
  const Eigen::Vector2d position = w.film.film->problem().displacement;
  s.eccentricity                 = position.norm();
  s.attitude                     = std::atan2(position[1], position[0]);
  s.least_film                   = r.least_film * u.clearance;
  s.peak_pressure                = r.peak_pressure * u.pressure;
  s.temperature                  = w.temperature;
  s.outlet_temperature           = b.inlet_temperature + warming(b, load, w.film, w.temperature);
  s.sommerfeld                   = sommerfeld_number(load.load / u.force);
  s.friction_torque              = r.friction * u.torque;
  s.power_loss                   = s.friction_torque * load.speed;
  s.power_streamers              = r.friction_streamers * u.torque * load.speed;
  s.side_flow                    = r.side_flow * u.flow;
  const double compliance        = layer_compliance(b);
  const double W                 = load.load / u.force;
  s.layer_stiffness = compliance > 0 ? W * W / squared_pressure(*w.film.film) * u.force / (compliance * u.pressure)
                                     : std::numeric_limits<double>::infinity();
  w.film.film->place_rupture();
  const FilmCoefficients c = film_coefficients(*w.film.film, true, load.tilt.norm() > 0);
  s.stiffness              = c.stiffness * (u.force / u.clearance);
  s.damping                = c.damping * (u.force / (u.clearance * u.speed));
  s.tilting_stiffness      = c.tilting(0, 0) * u.force / u.clearance * b.length * b.length / 4;
  return s;
}

// (4 fine - coarse) / 3 of every number; exact for an error that falls with the square of the mesh size.
OilFilmState extrapolated(const OilFilmState &fine, const OilFilmState &coarse)
{
  OilFilmState out     = fine;
  const auto from_both = [](const auto &a, const auto &b) { return a + (a - b) / 3; };
  for (double OilFilmState::*number :
       {&OilFilmState::eccentricity, &OilFilmState::attitude, &OilFilmState::least_film,
        &OilFilmState::peak_pressure, &OilFilmState::temperature, &OilFilmState::outlet_temperature,
        &OilFilmState::viscosity, &OilFilmState::sommerfeld, &OilFilmState::friction_torque,
        &OilFilmState::power_loss, &OilFilmState::power_streamers, &OilFilmState::side_flow,
        &OilFilmState::tilting_stiffness})
    out.*number = from_both(fine.*number, coarse.*number);
  if (std::isfinite(fine.layer_stiffness))
    out.layer_stiffness = from_both(fine.layer_stiffness, coarse.layer_stiffness);
  out.stiffness = fine.stiffness + (fine.stiffness - coarse.stiffness) / 3;
  out.damping   = fine.damping + (fine.damping - coarse.damping) / 3;
  return out;
}

void require_bearing(const OilFilmBearing &b, const OilFilmLoad &load)
{
  require_input(b.diameter > 0 && b.length > 0 && b.clearance > 0,
                "an oil-film bearing needs a diameter, a length and a clearance above zero");
  require_input(load.load > 0, "an oil film without a load has no stiffness: the load must be above zero");
  require_input(load.speed > 0,
                "a sleeve that stands still drags no oil into the film: the speed must be above zero");
}
}  // namespace

double layer_compliance(const OilFilmBearing &b)
{
  return layer_of(b.bush_thickness, b.bush_modulus, b.bush_poisson) +
         layer_of(b.sleeve_thickness, b.sleeve_modulus, b.sleeve_poisson);
}

FilmProblem film_problem(const OilFilmBearing &b, const OilFilmLoad &load, const double viscosity)
{
  const Units u = units_of(b, load, viscosity);
  FilmProblem p;
  p.length_ratio       = b.length / b.diameter;
  p.tilt               = load.tilt * (b.length / 2 / b.clearance);
  p.pressure_viscosity = b.pressure_viscosity * u.pressure;
  p.compliance         = layer_compliance(b) * u.pressure / b.clearance;
  for (int k = 0; k < b.grooves; ++k)
    p.grooves.push_back(
        {b.groove_angle + k * M_PI, b.groove_width, b.groove_length, b.feed_pressure / u.pressure});
  return p;
}

CoarseOilFilm coarse_oil_film(const OilFilmBearing &b, const OilFilmLoad &load, const BalancedFilm *near)
{
  require_bearing(b, load);
  const WarmFilm w = warm_film(b, load, 1, nullptr, near);
  return {state_of(b, load, w), w.film};
}

OilFilmSolution solve_oil_film(const OilFilmBearing &b, const OilFilmLoad &load)
{
  require_bearing(b, load);
  const WarmFilm coarse = warm_film(b, load, 1, nullptr, nullptr);
  const WarmFilm fine   = warm_film(b, load, 2, &coarse, nullptr);
  OilFilmSolution s;
  s.coarse = state_of(b, load, coarse);
  s.fine   = state_of(b, load, fine);
  s.at     = extrapolated(s.fine, s.coarse);
  s.film   = fine.film;
  return s;
}

double least_carrying_film(const OilFilmBearing &b)
{
  return std::max(3 * b.roughness, 0.02 * b.clearance);
}

bool carries(const OilFilmBearing &b, const OilFilmState &state)
{
  return state.least_film >= least_carrying_film(b);
}

double least_speed(const OilFilmBearing &b, OilFilmLoad load)
{
  const auto film_at = [&](const double speed) {
    load.speed = speed;
    try {
      return carries(b, coarse_oil_film(b, load).at);
    } catch (const SolverError &) {
      return false;
    }
  };
  double low = 1e-5, high = 1e5;
  if (!film_at(high)) {  // a hot film may fail at a speed at which a cooler one carries
    while (high > low && !film_at(high))
      high /= 4;
    if (high <= low)
      return not_given;
  }
  while (high / low > 1.0005) {
    const double middle            = std::sqrt(low * high);
    (film_at(middle) ? high : low) = middle;
  }
  return high;
}
}  // namespace mill::bearing
