#pragma once
#include "reduce/bearing/oil_film/film.h"

namespace mill::bearing {
/// What a film does to its sleeve, in the units of FilmProblem: forces in mu w (R/c)^2 R L/2, moments in half
/// lengths of that.
struct FilmReactions {
  Eigen::Vector2d force;       ///< along the load and across it, against the sleeve
  Eigen::Vector2d moment;      ///< of the same about mid-length
  double peak_pressure;        ///< -
  Eigen::Vector2d peak_place;  ///< rad from the load, z
  double least_film;           ///< -, of c
  double friction;             ///< -, torque on the sleeve in mu w R^3 L/2 / c, all gaps full
  double friction_streamers;   ///< -, the same with the ruptured film in streamers
  double side_flow;            ///< -, out of both ends, in R c w L/2
};
FilmReactions film_reactions(const Film &film);

/// Changes of the forces, theory.md (29.7) and (29.8): force = stiffness displacement + damping velocity, both
/// against the motion.
struct FilmCoefficients {
  Eigen::Matrix2d stiffness;  ///< of forces by displacement, in unit of force / c
  Eigen::Matrix2d damping;    ///< by velocity, in unit of force / (c w)
  Eigen::Matrix2d by_tilt;    ///< of forces by tilt at the end
  Eigen::Matrix2d tilting;    ///< of moments by tilt at the end
};
/// @param with_damping  else only the stiffness is made
FilmCoefficients film_coefficients(const Film &film, bool with_damping = true, bool with_tilt = false);

/// Sommerfeld number mu N D L / W (R/c)^2 of a force.  theory.md (29.5)
double sommerfeld_number(double force);
}  // namespace mill::bearing
