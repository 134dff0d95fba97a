#pragma once
#include "reduce/bearing/oil_film/oil_film_state.h"
#include <optional>

// Numbers of one oil film with their errors and what they are compared with: no text, no files.
namespace mill::bearing {
/// The rigid, aligned film with a parabola along the bearing, and the short bearing (Ocvirk), at load and
/// viscosity of a state.  theory.md 29.6
struct SimplerFilms {
  double eccentricity;            ///< -, of the parabola
  double attitude;                ///< rad
  double least_film;              ///< m
  Eigen::Matrix2d stiffness;      ///< N/m
  double sommerfeld;              ///< -, at the eccentricity of the state
  double short_eccentricity;      ///< -
  double short_attitude;          ///< rad
  Eigen::Matrix2d short_damping;  ///< N s/m
  double short_peak;              ///< Pa
  double short_flow;              ///< m3/s, at the eccentricity of the parabola
  double full_friction;           ///< N m, film that does not rupture, at the eccentricity of the parabola
  double full_loss;               ///< W
  double warming;                 ///< K, by full_loss and short_flow
};
/// Cost: some ms.
SimplerFilms simpler_films(const OilFilmBearing &bearing, const OilFilmLoad &load, const OilFilmState &state);

/// Relative error of every number of a solution: two grids of second order; of losses and friction torque also
/// what oil in streamers behind the rupture would change.
OilFilmState relative_errors(const OilFilmSolution &solution);

/// Stiffness along the load, free to move across.
struct FreeStiffness {
  double value;     ///< N/m
  double error;     ///< -, relative, of two grids
  double by_loads;  ///< N/m, difference of two loads, at the temperature of the state
};

/// One film: its solution, the errors and what it is compared with.
struct FilmNumbers {
  OilFilmSolution solution;
  OilFilmState error;  ///< -, relative, of each number of the solution
  SimplerFilms simpler;
  FreeStiffness free;
  double least_speed;  ///< rad/s, least_speed()
};
/// @param solution  of this bearing under this load
/// @throws SolverError  no film at a load half a per cent from this one
/// Cost: least_speed(), and two solutions.
FilmNumbers film_numbers(const OilFilmBearing &bearing, const OilFilmLoad &load, OilFilmSolution solution);

/// Rigid film along the load and layers as plain springs in series, N/m, at the temperature of the state; nothing
/// where between rigid surfaces no film carries.
std::optional<double> series_stiffness(OilFilmBearing bearing, const OilFilmLoad &load, const OilFilmState &state);

/// The state under a load, where a film carries it.
std::optional<OilFilmState> carrying_state(const OilFilmBearing &bearing, const OilFilmLoad &load);
}  // namespace mill::bearing
