#pragma once
#include <Eigen/Core>
#include <vector>

// Film between a turning sleeve and its bush, in ratios.  theory.md 29.1: angles from the direction of the load
// onwards in the direction of rotation, z in half lengths, lengths across the film in radial clearances c,
// pressure in mu w (R/c)^2 with the viscosity mu at the film's temperature and no pressure, time in 1/w.
namespace mill::bearing {
/// A recess of the bush that is kept full of oil.
struct FilmGroove {
  double angle;         ///< rad, of its middle
  double width;         ///< rad, around
  double length;        ///< -, of the bearing's length, in its middle
  double pressure = 0;  ///< -, of the oil in it
};

/// What a film is asked.
struct FilmProblem {
  double length_ratio          = 1;       ///< -, length over diameter
  Eigen::Vector2d displacement = {0, 0};  ///< -, of the sleeve's axis: along the load, across it
  Eigen::Vector2d tilt         = {0, 0};  ///< -, the same at the end z = 1, beyond that at mid-length
  double pressure_viscosity    = 0;       ///< -, Barus' exponent times the unit of pressure
  double compliance            = 0;       ///< -, radial deflection of bush and sleeve per pressure
  bool from_widest_gap         = false;   ///< no pressure at the widest gap, as in published charts
  bool ruptures = true;  ///< false: the film holds any tension, for comparison with Sommerfeld's solution
  std::vector<FilmGroove> grooves;
};

/// Grid of one film: intervals of the circle and of half the length, each cut into `fineness` of the same kind.
struct FilmMesh {
  int around   = 60;
  int along    = 6;
  int fineness = 2;
};
}  // namespace mill::bearing
