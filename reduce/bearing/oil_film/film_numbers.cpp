#include "reduce/bearing/oil_film/film_numbers.h"
#include "core/base/errors.h"
#include "core/numerics/mesh_pair.h"
#include "reduce/bearing/oil_film/closed_forms.h"
#include "reduce/bearing/oil_film/parabolic_film.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

namespace mill::bearing {
namespace {
// Turns numbers in the axes of a force (r, t) into those along it and 90 degrees on.
Eigen::Matrix2d along_force(const Eigen::Matrix2d &m, const Eigen::Vector2d &force)
{
  Eigen::Matrix2d axes;
  axes << force[0], -force[1], force[1], force[0];
  axes /= force.norm();
  return axes.transpose() * m * axes;
}

Eigen::Matrix2d parabolic_stiffness(const double length_ratio, const double e)
{
  const double step       = 1e-3 * std::min(e, 1 - e);
  const Eigen::Vector2d f = parabolic_force(length_ratio, e);
  Eigen::Matrix2d k;
  k.col(0) = (parabolic_force(length_ratio, e + step) - parabolic_force(length_ratio, e - step)) / (2 * step);
  k.col(1) = Eigen::Vector2d(-f[1], f[0]) / e;
  return along_force(k, f);
}

double short_peak(const double length_ratio, const double e)
{
  double peak = 0;
  for (int i = 0; i < 720; ++i) {
    const double t = M_PI * i / 720;
    peak = std::max(peak, 3 * length_ratio * length_ratio * e * std::sin(t) / std::pow(1 + e * std::cos(t), 3));
  }
  return peak;
}

double free_along(const OilFilmState &state)
{
  return 1 / state.stiffness.inverse()(0, 0);
}

// A slope belongs to one temperature.
OilFilmBearing held_warm(OilFilmBearing b, const OilFilmState &state)
{
  b.viscosity  = {{state.temperature, state.viscosity}};
  b.heat_share = 0;
  return b;
}

double slope_between_loads(const OilFilmBearing &bearing, const OilFilmLoad &load, const OilFilmState &state)
{
  constexpr double part  = 5e-3;
  const OilFilmBearing b = held_warm(bearing, state);
  const auto place       = [&](const double factor) {
    OilFilmLoad other = load;
    other.load *= factor;
    const OilFilmState s = solve_oil_film(b, other).at;
    return b.clearance * s.eccentricity * std::cos(s.attitude);
  };
  return 2 * part * load.load / (place(1 + part) - place(1 - part));
}
}  // namespace

SimplerFilms simpler_films(const OilFilmBearing &b, const OilFilmLoad &load, const OilFilmState &state)
{
  const double R = b.diameter / 2, half = b.length / 2, w = load.speed, ratio = R / b.clearance;
  const double pressure = state.viscosity * w * ratio * ratio, force = pressure * R * half, W = load.load / force;
  const double slender = b.length / b.diameter;
  SimplerFilms s;
  s.eccentricity          = parabolic_eccentricity(slender, W);
  const Eigen::Vector2d f = parabolic_force(slender, s.eccentricity);
  s.attitude              = -std::atan2(f[1], f[0]);
  s.least_film            = b.clearance * (1 - s.eccentricity);
  s.stiffness             = parabolic_stiffness(slender, s.eccentricity) * force / b.clearance;
  s.sommerfeld            = sommerfeld_number(parabolic_force(slender, state.eccentricity).norm());
  s.short_eccentricity    = ocvirk_eccentricity(slender, W);
  s.short_attitude        = ocvirk_attitude(s.short_eccentricity);
  s.short_damping         = ocvirk_coefficients(s.short_eccentricity).damping * load.load / (b.clearance * w);
  s.short_peak            = short_peak(slender, s.short_eccentricity) * pressure;
  s.short_flow            = 2 * s.eccentricity * R * b.clearance * w * half;
  s.full_friction         = (petroff_friction() / std::sqrt(1 - s.eccentricity * s.eccentricity) +
                     s.eccentricity * W * std::sin(s.attitude) / 2) *
                    state.viscosity * w * R * R * ratio * half;
  s.full_loss = s.full_friction * w;
  s.warming   = b.heat_share * s.full_friction * w / (b.oil_density * b.oil_heat * s.short_flow);
  return s;
}

OilFilmState relative_errors(const OilFilmSolution &s)
{
  OilFilmState error;
  const auto pair = [](const double fine, const double coarse) {
    return mesh_pair_error(fine, coarse, second_order);
  };
  for (double OilFilmState::*number :
       {&OilFilmState::eccentricity, &OilFilmState::attitude, &OilFilmState::least_film,
        &OilFilmState::peak_pressure, &OilFilmState::temperature, &OilFilmState::outlet_temperature,
        &OilFilmState::viscosity, &OilFilmState::sommerfeld, &OilFilmState::friction_torque,
        &OilFilmState::power_loss, &OilFilmState::power_streamers, &OilFilmState::side_flow,
        &OilFilmState::layer_stiffness, &OilFilmState::tilting_stiffness})
    error.*number = pair(s.fine.*number, s.coarse.*number);
  error.stiffness        = s.fine.stiffness.binaryExpr(s.coarse.stiffness, pair);
  error.damping          = s.fine.damping.binaryExpr(s.coarse.damping, pair);
  const double streamers = std::abs(s.at.power_streamers / s.at.power_loss - 1);
  error.power_loss += streamers;
  error.friction_torque += streamers;
  return error;
}

FilmNumbers film_numbers(const OilFilmBearing &b, const OilFilmLoad &load, OilFilmSolution solution)
{
  FilmNumbers out;
  out.least_speed = least_speed(b, load);
  out.error       = relative_errors(solution);
  out.simpler     = simpler_films(b, load, solution.at);
  out.free        = {free_along(solution.at),
                     mesh_pair_error(free_along(solution.fine), free_along(solution.coarse), second_order),
                     slope_between_loads(b, load, solution.at)};
  out.solution    = std::move(solution);
  return out;
}

std::optional<double> series_stiffness(OilFilmBearing b, const OilFilmLoad &load, const OilFilmState &state)
{
  b                = held_warm(std::move(b), state);
  b.bush_thickness = b.sleeve_thickness = not_given;
  try {
    return 1 / (1 / solve_oil_film(b, load).at.stiffness(0, 0) + 1 / state.layer_stiffness);
  } catch (const SolverError &) {
    return {};
  }
}

std::optional<OilFilmState> carrying_state(const OilFilmBearing &b, const OilFilmLoad &load)
{
  try {
    const OilFilmState s = solve_oil_film(b, load).at;
    if (carries(b, s))
      return s;
  } catch (const SolverError &) {  // a curve has a gap there
  }
  return {};
}
}  // namespace mill::bearing
