#pragma once
#include "reduce/bearing/oil_film/film_problem.h"

namespace mill::bearing {
/// Nodes and control volumes of a film.  Columns lie around the bearing, rows along it; without tilt only one half
/// of the length is kept, from mid-length (row 0) to the end.  The rows at the ends carry no pressure and are not
/// kept.
struct FilmGrid {
  Eigen::VectorXd angle;    ///< (columns) rad
  Eigen::VectorXd gap;      ///< (columns) rad, from a node to the next one
  Eigen::VectorXd width;    ///< (columns) rad, of the control volume
  Eigen::VectorXd z;        ///< (rows)
  Eigen::VectorXd z_gap;    ///< (rows + 1) from one row to the next, the ends included; 0 at a plane of symmetry
  Eigen::VectorXd z_width;  ///< (rows) of the control volume
  Eigen::MatrixXd held;     ///< (rows, columns) pressure of a groove or of the widest gap; NaN where it is free
  double mirror = 1;        ///< -, 2 when one half of the length represents both
  Eigen::Index columns() const
  {
    return angle.size();
  }
  Eigen::Index rows() const
  {
    return z.size();
  }
};

/// Grid that is finer where the film is thin, with a node on each edge of a groove.  Between two edges the angle
/// follows Sommerfeld's substitution of half the strength, theory.md (29.6).
FilmGrid film_grid(const FilmProblem &problem, const FilmMesh &mesh);

/// Distance between rigid surfaces at an angle and a place along, theory.md (29.1).
double rigid_film(const FilmProblem &problem, double angle, double z);

/// The least distance between rigid surfaces: at an end of a tilted sleeve.
double least_rigid_film(const FilmProblem &problem);
}  // namespace mill::bearing
