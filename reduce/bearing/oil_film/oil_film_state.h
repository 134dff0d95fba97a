#pragma once
#include "core/model/oil_film_bearing.h"
#include "reduce/bearing/oil_film/film_balance.h"

namespace mill::bearing {
/// What acts on an oil-film bearing.
struct OilFilmLoad {
  double load          = 0;       ///< N
  double speed         = 0;       ///< rad/s, of the sleeve
  Eigen::Vector2d tilt = {0, 0};  ///< rad, of the sleeve: in the plane of the load, and across it
};

/// One state of an oil-film bearing.  Matrices: first axis along the load, second 90 degrees on in the direction
/// of rotation.
struct OilFilmState {
  double eccentricity       = 0;  ///< -, over the radial clearance
  double attitude           = 0;  ///< rad, from the load to the line of centres
  double least_film         = 0;  ///< m
  double peak_pressure      = 0;  ///< Pa
  double temperature        = 0;  ///< K, of the film
  double outlet_temperature = 0;  ///< K
  double viscosity          = 0;  ///< Pa s, without pressure
  double sommerfeld         = 0;  ///< -
  double friction_torque    = 0;  ///< N m
  double power_loss         = 0;  ///< W, all gaps full of oil
  double power_streamers    = 0;  ///< W, oil in streamers behind the rupture
  double side_flow          = 0;  ///< m3/s, out of both ends
  double layer_stiffness    = 0;  ///< N/m, of bush and sleeve under the film's pressure; infinite: rigid
  double tilting_stiffness  = 0;  ///< N m/rad, in the plane of the load, of a tilted film; else 0
  Eigen::Matrix2d stiffness = Eigen::Matrix2d::Zero();  ///< N/m
  Eigen::Matrix2d damping   = Eigen::Matrix2d::Zero();  ///< N s/m
};

/// A state by two grids: extrapolated (Richardson, second order), and on either.
struct OilFilmSolution {
  OilFilmState at, fine, coarse;
  BalancedFilm film;  ///< on the finer grid
};

/// Balances load and heat at one speed.  theory.md 29.4
/// @throws InputError   load or speed not above zero, a bearing that is none
/// @throws SolverError  no film carries
OilFilmSolution solve_oil_film(const OilFilmBearing &bearing, const OilFilmLoad &load);

/// The same on the coarser grid alone: for searches and curves.
/// @param near  of a neighbouring state, or null
struct CoarseOilFilm {
  OilFilmState at;
  BalancedFilm film;
};
CoarseOilFilm coarse_oil_film(const OilFilmBearing &bearing, const OilFilmLoad &load,
                              const BalancedFilm *near = nullptr);

/// Thinnest film that still parts the surfaces: three times their roughness, and 2 % of the clearance.
double least_carrying_film(const OilFilmBearing &bearing);
/// Does a film of this state carry without the surfaces touching?
bool carries(const OilFilmBearing &bearing, const OilFilmState &state);
/// rad/s, least speed at which a film carries this load; NaN when none up to 10^5 rad/s does.
double least_speed(const OilFilmBearing &bearing, OilFilmLoad load);

/// Radial deflection of bush and sleeve per pressure, m/Pa: layers that cannot widen, theory.md (29.16).
double layer_compliance(const OilFilmBearing &bearing);
/// The film of this state in ratios.
FilmProblem film_problem(const OilFilmBearing &bearing, const OilFilmLoad &load, double viscosity);
}  // namespace mill::bearing
